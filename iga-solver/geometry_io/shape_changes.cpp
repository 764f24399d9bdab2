// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/shape_changes.h"

#include <fmt/format.h>

#include "geometry_io/placement.h"
#include "geometry_io/shape_limits.h"
#include "geometry_io/wall_size.h"
#include "nurbs/refinement.h"

namespace geometry_io {

using nurbs::Patch;
using nurbs::Vector3;

namespace {

/// One whole number for all directions or one for each.
std::vector<int> per_direction(const YamlMap& map, const std::string& key, int dim, int high) {
  if (!map.is_list(key)) return std::vector<int>(dim, map.integer(key, 1, high));
  const std::vector<int> numbers = map.integers(key, 1, high);
  expect_count(map, key, numbers.size(), dim);
  return numbers;
}

template <int Dim>
void raise_degree(const YamlMap& map, Patch<Dim>& patch) {
  const std::vector<int> degrees = per_direction(map, "degree", Dim, nurbs::max_degree(Dim));
  std::vector<int> counts, others;
  for (int d = 0; d < Dim; ++d) {
    const int given = patch.space.degree(d);
    if (degrees[d] < given)
      map.fail("degree",
               fmt::format("degree is {} in direction {}, expected at least the {} that the patch has",
                           degrees[d], d + 1, given));
    const int elements = patch.space.knots(d).element_count();  // each gets so many control points more
    counts.push_back(elements);
    others.push_back(patch.space.control_point_count(d) + (degrees[d] - given - 1) * elements);
  }
  expect_size(map, "degree", counts, others);
  for (int d = 0; d < Dim; ++d) {
    const int given = patch.space.degree(d);
    if (degrees[d] > given) patch = nurbs::elevate_degree(patch, d, degrees[d] - given);
  }
}

template <int Dim>
void expect_room(const YamlMap& map, const std::string& key, const Patch<Dim>& patch,
                 const std::vector<int>& elements) {
  std::vector<int> others;  // control points are as many as elements, the degree, and knots that are repeated
  for (int d = 0; d < Dim; ++d)
    others.push_back(patch.space.control_point_count(d) - patch.space.knots(d).element_count());
  expect_size(map, key, elements, others);
}

template <int Dim>
void divide_elements(const YamlMap& map, Patch<Dim>& patch) {
  const std::vector<int> parts = per_direction(map, "divide", Dim, shape_limits().elements);
  std::vector<int> elements;
  for (int d = 0; d < Dim; ++d) {
    const double count = static_cast<double>(patch.space.knots(d).element_count()) * parts[d];
    if (count > shape_limits().elements)
      map.fail("divide", fmt::format("divide: {:.0f} elements in direction {}, expected at most {}", count,
                                     d + 1, shape_limits().elements));
    elements.push_back(static_cast<int>(count));
  }
  expect_room(map, "divide", patch, elements);
  for (int d = 0; d < Dim; ++d) {
    const std::vector<double>& breaks = patch.space.knots(d).breaks();
    std::vector<double> added;
    for (size_t e = 0; e + 1 < breaks.size(); ++e)
      for (int k = 1; k < parts[d]; ++k)
        added.push_back(breaks[e] + (breaks[e + 1] - breaks[e]) * k / parts[d]);
    patch = nurbs::insert_knots(patch, d, added);
  }
}

template <int Dim>
void insert_knots(const YamlMap& map, Patch<Dim>& patch) {
  const std::vector<std::vector<double>> knots = map.table("knots");
  expect_count(map, "knots", knots.size(), Dim);
  std::vector<int> elements;
  for (int d = 0; d < Dim; ++d)
    elements.push_back(patch.space.knots(d).element_count() + static_cast<int>(knots[d].size()));
  expect_room(map, "knots", patch, elements);
  for (int d = 0; d < Dim; ++d)
    blame(map, "knots", fmt::format("knots of direction {}: ", d + 1),
          [&] { patch = nurbs::insert_knots(patch, d, knots[d]); });
}

template <int Dim>
void refine(const YamlMap& map, Patch<Dim>& patch) {
  if (map.has("degree")) raise_degree(map, patch);
  if (map.has("divide")) divide_elements(map, patch);
  if (map.has("knots")) insert_knots(map, patch);
}

Vector3 read_scale(const YamlMap& geometry) {
  Vector3 factors;
  if (geometry.is_list("scale"))
    factors = geometry.vector3("scale");
  else
    factors.setConstant(geometry.number("scale", positive()));
  if (!(factors.minCoeff() > 0.0))
    geometry.fail("scale", fmt::format("scale is [{}, {}, {}], expected numbers > 0", factors[0], factors[1],
                                       factors[2]));
  return factors;
}

Placement read_rotation(const YamlMap& map) {
  map.allow_only({"origin", "axis", "angle"});
  const Vector3 axis = map.vector3("axis"),
                origin = map.has("origin") ? map.vector3("origin") : Vector3(Vector3::Zero());
  if (!(axis.stableNorm() > 0.0)) map.fail("axis", "axis is [0, 0, 0], expected a direction");
  return turning(axis, map.number("angle"), origin);
}

template <int Dim>
nurbs::NodalVectors& points_of(Patch<Dim>& patch) {
  return patch.control_points;
}
nurbs::NodalVectors& points_of(TriangleMesh& mesh) { return mesh.points; }

}  // namespace

const std::vector<std::string>& change_words() {
  static const std::vector<std::string> kWords = {"refine", "scale", "rotate", "move"};
  return kWords;
}

Placement change_shapes(const YamlMap& geometry, std::vector<Shape>& patches) {
  if (geometry.has("refine")) {
    const YamlMap map = geometry.map("refine");
    map.allow_only({"degree", "divide", "knots"});
    for (Shape& shape : patches)
      blame(geometry, "refine",
            "refine: ", [&] { visit_nurbs(shape, [&](auto& patch) { refine(map, patch); }); });
  }
  Placement change = Placement::Identity();
  if (geometry.has("scale")) change = scaling(read_scale(geometry));
  if (geometry.has("rotate")) change = read_rotation(geometry.map("rotate")) * change;
  if (geometry.has("move")) change = shifting(geometry.vector3("move")) * change;
  if (!geometry.has("scale") && !geometry.has("rotate") && !geometry.has("move")) return change;
  for (Shape& shape : patches) std::visit([&](auto& patch) { place(points_of(patch), change); }, shape);
  return change;
}

void expect_scaled_size(const YamlMap& geometry, const Vector3& extents) {
  if (!geometry.has("scale")) return;
  const Vector3 factors = read_scale(geometry);
  const std::string problem = size_problem(extents, factors);
  if (problem.empty()) return;
  geometry.fail("scale", fmt::format("scale is {}: the shape becomes {}",
                                     geometry.is_list("scale")
                                         ? fmt::format("[{}, {}, {}]", factors[0], factors[1], factors[2])
                                         : fmt::format("{}", factors[0]),
                                     problem));
}

}  // namespace geometry_io

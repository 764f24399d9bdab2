// SPDX-License-Identifier: GPL-2.0-or-later
#include "vtk/bezier_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "nurbs/refinement.h"

namespace vtk {
namespace {

using nurbs::Indices;
using nurbs::KnotVector;
using nurbs::NodalVectors;
using nurbs::Patch;

constexpr std::uint8_t kQuadrilateral = 77, kHexahedron = 79;

// Corners, edges, faces and inside of a cell in VTK's order; per direction L(ow), H(igh) or I(nside).  A
// quadrilateral is what lies in the plane zeta = L.
constexpr const char* kParts[] = {"LLL", "HLL", "HHL", "LHL", "LLH", "HLH", "HHH", "LHH", "ILL",
                                  "HIL", "IHL", "LIL", "ILH", "HIH", "IHH", "LIH", "LLI", "HLI",
                                  "HHI", "LHI", "LII", "HII", "ILI", "IHI", "IIL", "IIH", "III"};

// Knots that are missing until every interior knot stands as often as the degree.
std::vector<double> missing_knots(const KnotVector& knots) {
  std::vector<double> missing;
  const std::vector<double>&all = knots.knots(), &breaks = knots.breaks();
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i)
    missing.insert(missing.end(), knots.degree() - std::count(all.begin(), all.end(), breaks[i]), breaks[i]);
  return missing;
}

// The same patch on Bezier points: p n + 1 in a direction of n elements.
template <int Dim>
Patch<Dim> bezier_form(Patch<Dim> patch) {
  for (int d = 0; d < Dim; ++d) patch = nurbs::insert_knots(patch, d, missing_knots(patch.space.knots(d)));
  return patch;
}

// A field on Bezier points: refined as the geometry is, three components at a time.
template <int Dim>
Eigen::MatrixXd bezier_form(const nurbs::Space<Dim>& space, const Eigen::MatrixXd& q) {
  Eigen::MatrixXd result;
  for (int first = 0; first < q.rows(); first += 3) {
    const int count = std::min<int>(3, static_cast<int>(q.rows()) - first);
    NodalVectors block = NodalVectors::Zero(3, q.cols());
    block.topRows(count) = q.middleRows(first, count);
    const Patch<Dim> refined = bezier_form(Patch<Dim>{space, std::move(block)});
    result.conservativeResize(first + count, refined.control_points.cols());
    result.middleRows(first, count) = refined.control_points.topRows(count);
  }
  return result;
}

void append(Eigen::MatrixXd& all, const Eigen::MatrixXd& more) {
  const Eigen::Index before = all.cols();
  all.conservativeResize(more.rows(), before + more.cols());
  all.rightCols(more.cols()) = more;
}

std::string in_unit(const Field& field) { return field.unit.empty() ? "" : " in " + field.unit; }

void check_fields(const std::vector<Field>& given, const std::vector<Field>& first, int count,
                  const char* where) {
  if (given.size() != first.size())
    throw std::invalid_argument(
        fmt::format("{} fields {}, expected {} as on the first patch", given.size(), where, first.size()));
  for (std::size_t f = 0; f < given.size(); ++f) {
    const Field &field = given[f], &expected = first[f];
    if (field.name != expected.name || field.values.rows() != expected.values.rows() ||
        field.unit != expected.unit)
      throw std::invalid_argument(fmt::format("field '{}' with {} components{}, expected '{}' with {}{}",
                                              field.name, field.values.rows(), in_unit(field), expected.name,
                                              expected.values.rows(), in_unit(expected)));
    if (field.values.cols() != count)
      throw std::invalid_argument(fmt::format("field '{}' has {} values {}, expected {}", field.name,
                                              field.values.cols(), where, count));
    if (!field.values.allFinite())
      throw std::invalid_argument(fmt::format("field '{}' is not finite", field.name));
  }
}

// Appends the cells of a patch whose Bezier points start at `first_point`.
template <int Dim>
void append_cells(const nurbs::Space<Dim>& space, std::int64_t first_point, BezierCells& cells) {
  Indices<Dim> degrees, stride;
  for (int d = 0, s = 1; d < Dim; ++d) {
    degrees[d] = space.degree(d);
    stride[d] = s;
    s *= degrees[d] * space.knots(d).element_count() + 1;
  }
  std::vector<int> offset;  // of a cell's points from its first one, in VTK's order
  for (int lexicographic : point_order<Dim>(degrees)) {
    int sum = 0;
    for (int d = 0; d < Dim; ++d) {
      sum += lexicographic % (degrees[d] + 1) * stride[d];
      lexicographic /= degrees[d] + 1;
    }
    offset.push_back(sum);
  }
  for (int element = 0; element < space.element_count(); ++element) {
    const Indices<Dim> indices = space.element_indices(element);
    std::int64_t corner = first_point;
    for (int d = 0; d < Dim; ++d) corner += indices[d] * degrees[d] * stride[d];
    for (int o : offset) cells.connectivity.push_back(corner + o);
    cells.offsets.push_back(static_cast<std::int64_t>(cells.connectivity.size()));
    for (int d = 0; d < 3; ++d) cells.degrees.push_back(d < Dim ? degrees[d] : 1);
  }
}

}  // namespace

template <int Dim>
std::vector<int> point_order(const Indices<Dim>& degrees) {
  std::vector<int> order;
  for (const char* part : kParts) {
    if (Dim == 2 && part[2] != 'L') continue;
    int begin[3] = {0, 0, 0}, end[3] = {1, 1, 1};
    for (int d = 0; d < Dim; ++d) {
      begin[d] = part[d] == 'L' ? 0 : part[d] == 'H' ? degrees[d] : 1;
      end[d] = part[d] == 'I' ? degrees[d] : begin[d] + 1;
    }
    for (int k = begin[2]; k < end[2]; ++k)
      for (int j = begin[1]; j < end[1]; ++j)
        for (int i = begin[0]; i < end[0]; ++i)
          order.push_back(i + (degrees[0] + 1) * (j + (degrees[1] + 1) * k));
  }
  return order;
}

template <int Dim>
nurbs::Space<Dim> bezier_space(const nurbs::Space<Dim>& space) {
  return bezier_form(Patch<Dim>{space, NodalVectors::Zero(3, space.control_point_count())}).space;
}

PatchFields<2> on_face(const PatchFields<3>& volume, nurbs::Face face) {
  const nurbs::BoundarySurface boundary = nurbs::boundary_surface(volume.patch.space, face);
  const std::vector<int>& control_points = boundary.volume_control_point;
  PatchFields<2> fields{{boundary.space, volume.patch.control_points(Eigen::all, control_points)}, {}, {}};
  for (const Field& field : volume.control_points)
    fields.control_points.push_back({field.name, field.values(Eigen::all, control_points), field.unit});
  if (volume.bezier_points.empty()) return fields;
  const std::vector<int> bezier_points =
      nurbs::boundary_surface(bezier_space(volume.patch.space), face).volume_control_point;
  for (const Field& field : volume.bezier_points)
    fields.bezier_points.push_back({field.name, field.values(Eigen::all, bezier_points), field.unit});
  return fields;
}

template <int Dim>
BezierCells bezier_cells(const std::vector<PatchFields<Dim>>& patches) {
  BezierCells cells{Dim == 2 ? kQuadrilateral : kHexahedron, {}, {}, {}, {}, {}, {}, {}};
  if (patches.empty()) return cells;
  const PatchFields<Dim>& first = patches.front();
  for (const Field& field : first.control_points) cells.point_fields.push_back({field.name, {}, field.unit});
  for (const Field& field : first.bezier_points) cells.point_fields.push_back({field.name, {}, field.unit});
  for (const Field& field : first.elements) cells.cell_fields.push_back({field.name, {}, field.unit});
  const bool rational = std::any_of(patches.begin(), patches.end(),
                                    [](const PatchFields<Dim>& p) { return p.patch.space.rational(); });

  for (const PatchFields<Dim>& fields : patches) {
    const nurbs::Space<Dim>& space = fields.patch.space;
    check_fields(fields.control_points, first.control_points, space.control_point_count(),
                 "per control point");
    check_fields(fields.elements, first.elements, space.element_count(), "per element");

    append_cells(space, static_cast<std::int64_t>(cells.points.size() / 3), cells);
    const Patch<Dim> bezier = bezier_form(fields.patch);
    const NodalVectors& points = bezier.control_points;
    check_fields(fields.bezier_points, first.bezier_points, static_cast<int>(points.cols()),
                 "per Bezier point");
    cells.points.insert(cells.points.end(), points.data(), points.data() + points.size());
    for (int a = 0; rational && a < points.cols(); ++a) cells.weights.push_back(bezier.space.weight(a));
    const std::size_t on_patch = fields.control_points.size();
    for (std::size_t f = 0; f < on_patch; ++f)
      append(cells.point_fields[f].values, bezier_form(space, fields.control_points[f].values));
    for (std::size_t f = 0; f < fields.bezier_points.size(); ++f)
      append(cells.point_fields[on_patch + f].values, fields.bezier_points[f].values);
    for (std::size_t f = 0; f < fields.elements.size(); ++f)
      append(cells.cell_fields[f].values, fields.elements[f].values);
  }
  return cells;
}

template std::vector<int> point_order<2>(const Indices<2>&);
template std::vector<int> point_order<3>(const Indices<3>&);
template nurbs::Space<2> bezier_space(const nurbs::Space<2>&);
template nurbs::Space<3> bezier_space(const nurbs::Space<3>&);
template BezierCells bezier_cells(const std::vector<PatchFields<2>>&);
template BezierCells bezier_cells(const std::vector<PatchFields<3>>&);

}  // namespace vtk

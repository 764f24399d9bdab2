// SPDX-License-Identifier: GPL-2.0-or-later
// Geometry in G+Smo's XML: tensor-product B-splines and NURBS, and multi-patch domains of them.  README.md of
// this folder says what is read.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

#include "geometry_io/formats.h"
#include "geometry_io/xml_input.h"

namespace geometry_io {
namespace {

using nurbs::KnotVector;
using pugi::xml_node;

// What may stand beside geometry in a file and says nothing about it.
constexpr const char* kPassedOver[] = {"Basis",      "MultiBasis", "Function",     "boundaryConditions",
                                       "OptionList", "Matrix",     "SparseMatrix", "Pde",
                                       "BVProblem"};

// Runs `build`; what it finds wrong with its arguments is an error of the file at `node`.
template <class Build>
auto blame(const XmlInput& file, xml_node node, Build build) {
  try {
    return build();
  } catch (const std::invalid_argument& error) {
    file.fail(node, fmt::format("<{}>: {}", node.name(), error.what()));
  }
}

void expect_attribute(const XmlInput& file, xml_node node, const char* name, const std::string& expected) {
  const std::string given = file.attribute(node, name);
  if (given != expected)
    file.fail(node,
              fmt::format("{} of <{}> is '{}', expected '{}'", name, node.name(), shown(given), expected));
}

// Numbers that G+Smo would take from another encoding or order, or generate, are refused.
std::vector<double> plain_numbers(const XmlInput& file, xml_node node) {
  for (const char* name : {"format", "order", "mode"}) {
    const std::string given = node.attribute(name).value();
    if (node.attribute(name) && given != "ascii" && given != "ASCII")
      file.fail(node, fmt::format("<{}> has {}='{}', expected numbers written out, point after point",
                                  node.name(), name, shown(given)));
  }
  return file.numbers(node);
}

KnotVector read_knots(const XmlInput& file, xml_node basis, int direction) {
  expect_attribute(file, basis, "type", "BSplineBasis");
  if (basis.attribute("index")) expect_attribute(file, basis, "index", std::to_string(direction));
  const xml_node knots = file.child(basis, "KnotVector");
  const int degree = file.integer_attribute(knots, "degree");
  return blame(file, knots, [&] { return KnotVector(degree, plain_numbers(file, knots)); });
}

template <size_t Dim>
std::array<KnotVector, Dim> read_tensor_basis(const XmlInput& file, xml_node basis) {
  expect_attribute(file, basis, "type", fmt::format("TensorBSplineBasis{}", Dim));
  std::vector<KnotVector> knots;
  for (const xml_node direction : basis.children("Basis"))
    knots.push_back(read_knots(file, direction, static_cast<int>(knots.size())));
  if (knots.size() != Dim)
    file.fail(basis, fmt::format("{} bases of one direction, expected {}", knots.size(), Dim));
  if constexpr (Dim == 2)
    return {knots[0], knots[1]};
  else
    return {knots[0], knots[1], knots[2]};
}

template <size_t Dim>
nurbs::Space<Dim> read_space(const XmlInput& file, xml_node geometry, bool rational) {
  const xml_node basis = file.child(geometry, "Basis");
  if (!rational) return nurbs::Space<Dim>(read_tensor_basis<Dim>(file, basis));
  expect_attribute(file, basis, "type", fmt::format("TensorNurbsBasis{}", Dim));
  const auto knots = read_tensor_basis<Dim>(file, file.child(basis, "Basis"));
  const xml_node weights = file.child(basis, "weights");
  return blame(file, weights, [&] {
    std::vector<double> values = plain_numbers(file, weights);
    if (values.empty()) throw std::invalid_argument("no weights given");
    return nurbs::Space<Dim>(knots, std::move(values));
  });
}

template <size_t Dim>
Shape read_patch(const XmlInput& file, xml_node geometry, bool rational) {
  nurbs::Space<Dim> space = read_space<Dim>(file, geometry, rational);
  const xml_node coefs = file.child(geometry, "coefs");
  const int geo_dim = file.integer_attribute(coefs, "geoDim");
  if (geo_dim != 3 && !(geo_dim == 2 && Dim == 2))
    file.fail(coefs, fmt::format("geoDim is {}, expected {}", geo_dim, Dim == 2 ? "3, or 2 for z = 0" : "3"));
  const std::vector<double> values = plain_numbers(file, coefs);
  const size_t expected = static_cast<size_t>(geo_dim) * space.control_point_count();
  if (values.size() != expected)
    file.fail(coefs, fmt::format("{} numbers in <coefs>, expected {}: {} control points of {} coordinates",
                                 values.size(), expected, space.control_point_count(), geo_dim));
  nurbs::NodalVectors points = nurbs::NodalVectors::Zero(3, space.control_point_count());
  points.topRows(geo_dim) = Eigen::Map<const Eigen::MatrixXd>(values.data(), geo_dim, points.cols());
  nurbs::Patch<Dim> patch{std::move(space), std::move(points)};
  blame(file, coefs, [&] { nurbs::check_patch(patch); });
  return patch;
}

struct GeometryType {
  const char* name;
  Shape (*read)(const XmlInput&, xml_node, bool rational);
  bool rational;
};
constexpr GeometryType kTypes[] = {
    {"TensorBSpline2", read_patch<2>, false},
    {"TensorBSpline3", read_patch<3>, false},
    {"TensorNurbs2", read_patch<2>, true},
    {"TensorNurbs3", read_patch<3>, true},
};
constexpr const char* kExpectedTypes =
    "TensorBSpline2, TensorBSpline3, TensorNurbs2 or TensorNurbs3, not trimmed";

Shape read_geometry(const XmlInput& file, xml_node geometry) {
  const std::string given = file.attribute(geometry, "type");
  const auto type = std::find_if(std::begin(kTypes), std::end(kTypes),
                                 [&](const GeometryType& known) { return given == known.name; });
  if (type == std::end(kTypes))
    file.fail(geometry, fmt::format("geometry of type '{}', expected {}", shown(given), kExpectedTypes));
  for (const xml_node part : geometry.children())
    if (part.name() != std::string("Basis") && part.name() != std::string("coefs"))
      file.fail(
          part,
          fmt::format("<{}> in <Geometry>, expected <Basis> and <coefs> only: no trimming, no transformation",
                      part.name()));
  return type->read(file, geometry, type->rational);
}

// The patches and names of a file, collected from its MultiPatch elements.
class Collector {
 public:
  Collector(const XmlInput& file, Units units) : file_(file), geometry_{units, {}, {}} {}

  GeometryFile collect() {
    bool multi_patch = false;
    for (const xml_node node : file_.root().children()) multi_patch |= classify(node);
    for (const xml_node node : file_.root().children(multi_patch ? "MultiPatch" : "Geometry"))
      multi_patch ? add_multi_patch(node) : add_patch(node);
    if (geometry_.patches.empty())
      file_.fail(file_.root(), "no <Geometry> in this file, expected one at least");
    if (geometry_.surfaces.empty()) name_all();
    return std::move(geometry_);
  }

 private:
  // True for a MultiPatch.
  bool classify(xml_node node) const {
    const std::string name = node.name();
    if (name == "MultiPatch") return true;
    if (name != "Geometry" &&
        std::find(std::begin(kPassedOver), std::end(kPassedOver), name) == std::end(kPassedOver))
      file_.fail(node,
                 fmt::format("<{}>, expected <Geometry> or <MultiPatch>: {}", shown(name), kExpectedTypes));
    return false;
  }

  void add_patch(xml_node node) { geometry_.patches.push_back(read_geometry(file_, node)); }

  // Index of the patch with this id, which is read when it is first asked for.
  int patch_of_id(int id, xml_node asked_by) {
    const auto known = patch_of_id_.find(id);
    if (known != patch_of_id_.end()) return known->second;
    xml_node found;
    for (const xml_node node : file_.root().children("Geometry")) {
      if (!node.attribute("id") || file_.integer_attribute(node, "id") != id) continue;
      if (found) file_.fail(node, fmt::format("second <Geometry> with id {}, expected one", id));
      found = node;
    }
    if (!found) file_.fail(asked_by, fmt::format("no <Geometry> with id {} in this file", id));
    add_patch(found);
    return patch_of_id_[id] = static_cast<int>(geometry_.patches.size()) - 1;
  }

  std::vector<int> ids(xml_node patches) const {
    const std::string type = file_.attribute(patches, "type");
    const std::vector<int> given = file_.integers(patches);
    if (type == "id_index") return given;
    if (type != "id_range")
      file_.fail(patches,
                 fmt::format("type of <patches> is '{}', expected id_range or id_index", shown(type)));
    constexpr int kMaxPatches = 1000000;
    if (given.size() != 2 || given[0] > given[1] || given[1] - static_cast<double>(given[0]) >= kMaxPatches)
      file_.fail(patches,
                 fmt::format("id_range is '{}', expected its first and last id", fmt::join(given, " ")));
    std::vector<int> range;
    for (int k = 0; k <= given[1] - given[0]; ++k) range.push_back(given[0] + k);  // the last may be INT_MAX
    return range;
  }

  void add_multi_patch(xml_node node) {
    const xml_node patches = file_.child(node, "patches");
    const int dim = file_.integer_attribute(node, "parDim");
    std::vector<SurfacePiece> pieces;
    for (const int id : ids(patches)) {
      const int p = patch_of_id(id, patches);
      const int given = std::holds_alternative<nurbs::Surface>(geometry_.patches[p]) ? 2 : 3;
      if (given != dim)
        file_.fail(node, fmt::format("geometry {} has {} parameters, expected parDim {}", id, given, dim));
      pieces.push_back({p, std::nullopt});
    }
    if (dim == 2 && node.attribute("label")) geometry_.surfaces[node.attribute("label").value()] = pieces;
    if (dim == 3)
      for (const xml_node boundary : node.children("boundary"))
        if (boundary.attribute("name")) add_boundary(boundary);
  }

  // Faces "patch side" of volumes; sides count from 1 in the order xi-, xi+, ... zeta+.
  void add_boundary(xml_node boundary) {
    const std::vector<int> pairs = file_.integers(boundary);
    if (pairs.size() % 2 != 0 || pairs.empty())
      file_.fail(boundary,
                 fmt::format("{} numbers in <boundary>, expected pairs of patch and side", pairs.size()));
    std::vector<SurfacePiece>& pieces = geometry_.surfaces[boundary.attribute("name").value()];
    for (size_t i = 0; i < pairs.size(); i += 2) {
      if (pairs[i + 1] < 1 || pairs[i + 1] > 6)
        file_.fail(boundary, fmt::format("side is {}, expected 1 to 6", pairs[i + 1]));
      pieces.push_back({patch_of_id(pairs[i], boundary), static_cast<nurbs::Face>(pairs[i + 1] - 1)});
    }
  }

  // A file that names no surface offers its patches as `all`, or the faces of its one volume.
  void name_all() {
    const int volumes =
        static_cast<int>(std::count_if(geometry_.patches.begin(), geometry_.patches.end(), is_volume));
    if (volumes == 0) geometry_.surfaces["all"] = parse_surface({"all"}, geometry_.patches);
    if (volumes == 1 && geometry_.patches.size() == 1)
      for (int face = 0; face < 6; ++face)
        geometry_.surfaces[nurbs::face_name(static_cast<nurbs::Face>(face))] = {
            {0, static_cast<nurbs::Face>(face)}};
  }

  const XmlInput& file_;
  GeometryFile geometry_;
  std::map<int, int> patch_of_id_;
};

}  // namespace

GeometryFile parse_gismo(const std::string& text, const std::string& file_name, Units units) {
  const XmlInput file(text, file_name);
  const xml_node root = file.root();
  if (root.name() != std::string("xml"))
    file.fail(root, fmt::format("<{}> at the top, expected <xml> as in files of G+Smo", shown(root.name())));
  if (root.attribute("units"))
    units = blame(file, root, [&] { return units_from_name(root.attribute("units").value()); });
  return Collector(file, units).collect();
}

}  // namespace geometry_io

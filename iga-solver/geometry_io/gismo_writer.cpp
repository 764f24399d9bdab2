// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pugixml.hpp>
#include <sstream>

#include "geometry_io/formats.h"
#include "nurbs/borders.h"

namespace geometry_io {
namespace {

using pugi::xml_node;

void set_text(xml_node node, const std::string& text) {
  node.append_child(pugi::node_pcdata).set_value(text.c_str());
}

// fmt's "{}" writes the shortest text that reads back as the same number.
template <class Numbers>
void set_numbers(xml_node node, const Numbers& numbers) {
  set_text(node, fmt::format("{}", fmt::join(numbers, " ")));
}

xml_node add(xml_node parent, const char* name, const std::string& type) {
  xml_node node = parent.append_child(name);
  node.append_attribute("type") = type.c_str();
  return node;
}

template <int Dim>
void write_patch(const nurbs::Patch<Dim>& patch, size_t id, xml_node root) {
  const bool rational = patch.space.rational();
  xml_node geometry =
      add(root, "Geometry", fmt::format("{}{}", rational ? "TensorNurbs" : "TensorBSpline", Dim));
  geometry.append_attribute("id") = id;
  xml_node outer = geometry;
  if (rational) outer = add(geometry, "Basis", fmt::format("TensorNurbsBasis{}", Dim));
  xml_node basis = add(outer, "Basis", fmt::format("TensorBSplineBasis{}", Dim));
  for (int d = 0; d < Dim; ++d) {
    xml_node direction = add(basis, "Basis", "BSplineBasis");
    direction.append_attribute("index") = d;
    xml_node knots = direction.append_child("KnotVector");
    knots.append_attribute("degree") = patch.space.degree(d);
    set_numbers(knots, patch.space.knots(d).knots());
  }
  if (rational) set_numbers(outer.append_child("weights"), patch.space.weights());
  xml_node coefs = geometry.append_child("coefs");
  coefs.append_attribute("geoDim") = 3;
  std::string points = "\n";
  for (const auto& point : patch.control_points.colwise())
    points += fmt::format("{} {} {}\n", point[0], point[1], point[2]);
  set_text(coefs, points);
}

// Topology as G+Smo has it: sides count from 1; an interface lists patch and side twice, for each direction
// of the first patch the one of the second, and whether they run the same way.
void write_topology(const std::vector<nurbs::Surface>& patches, xml_node multi_patch) {
  const auto borders = nurbs::find_borders(patches);
  std::string interfaces = "\n", boundary = "\n";
  for (int p = 0; p < static_cast<int>(patches.size()); ++p)
    for (int side = 0; side < nurbs::kSideCount; ++side) {
      const nurbs::Border& border = borders[p][side];
      if (border.kind != nurbs::Border::welded) boundary += fmt::format("{} {}\n", p, side + 1);
      if (border.kind != nurbs::Border::welded || std::pair(border.patch, border.side) < std::pair(p, side))
        continue;
      int map[2], same[2];
      const int across = side / 2;
      map[across] = border.side / 2, map[1 - across] = 1 - border.side / 2;
      same[across] = side % 2 != border.side % 2, same[1 - across] = !border.reversed;
      interfaces += fmt::format("{} {} {} {} {} {} {} {}\n", p, side + 1, border.patch, border.side + 1,
                                map[0], map[1], same[0], same[1]);
    }
  if (interfaces.size() > 1) set_text(multi_patch.append_child("interfaces"), interfaces);
  if (boundary.size() > 1) set_text(multi_patch.append_child("boundary"), boundary);
}

xml_node add_multi_patch(xml_node root, int dim, size_t id, const std::vector<int>& patches) {
  xml_node node = root.append_child("MultiPatch");
  node.append_attribute("parDim") = dim;
  node.append_attribute("id") = id;
  set_numbers(add(node, "patches", "id_index"), patches);
  return node;
}

// Names of volumes' faces belong to the whole domain; each named set of surfaces is a domain of its own.
void write_name(const std::string& name, const std::vector<SurfacePiece>& pieces, size_t id, xml_node root,
                xml_node domain) {
  std::vector<int> patches;
  std::string faces;
  for (const SurfacePiece& piece : pieces) {
    patches.push_back(piece.patch);
    if (piece.face) faces += fmt::format("{} {} ", piece.patch, static_cast<int>(*piece.face) + 1);
  }
  if (faces.empty()) {
    add_multi_patch(root, 2, id, patches).append_attribute("label") = name.c_str();
  } else {
    xml_node boundary = domain.append_child("boundary");
    boundary.append_attribute("name") = name.c_str();
    set_text(boundary, faces);
  }
}

}  // namespace

std::string write_gismo(const GeometryFile& geometry) {
  std::vector<nurbs::Surface> surfaces;
  std::vector<int> all;
  for (const Shape& shape : geometry.patches) {
    all.push_back(static_cast<int>(all.size()));
    if (const auto* surface = std::get_if<nurbs::Surface>(&shape)) surfaces.push_back(*surface);
  }
  if (!surfaces.empty() && surfaces.size() != geometry.patches.size())
    throw std::invalid_argument(
        "surfaces and volumes in one geometry: G+Smo's XML has one kind of patch, YAML and HDF5 hold both");

  pugi::xml_document document;
  xml_node root = document.append_child("xml");
  root.append_attribute("units") = units_name(geometry.units);
  for (size_t p = 0; p < geometry.patches.size(); ++p)
    visit_nurbs(geometry.patches[p], [&](const auto& patch) { write_patch(patch, p, root); });
  size_t id = geometry.patches.size();
  xml_node domain = add_multi_patch(root, surfaces.empty() ? 3 : 2, id++, all);
  if (!surfaces.empty()) write_topology(surfaces, domain);
  for (const auto& [name, pieces] : geometry.surfaces) write_name(name, pieces, id++, root, domain);
  std::ostringstream text;
  document.save(text, " ");
  return text.str();
}

}  // namespace geometry_io

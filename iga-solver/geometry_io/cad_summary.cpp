// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/cad_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "geometry_io/cad_measures.h"

namespace geometry_io {
namespace {

using brep::CadFace;
using brep::CadModel;

constexpr std::array kKinds = {"plane", "cylinder", "cone", "sphere", "torus", "spline"};

std::string named(const std::string& name) { return name.empty() ? "" : fmt::format(" '{}'", name); }
std::string coloured(int colour) { return colour < 0 ? "" : fmt::format(", colour:{:06X}", colour); }
const char* plural(size_t count) { return count == 1 ? "" : "s"; }

std::string solids_text(const CadModel& model) {
  std::string text;
  for (size_t s = 0; s < model.solids.size(); ++s) {
    const brep::CadSolid& solid = model.solids[s];
    const auto faces = std::count_if(model.faces.begin(), model.faces.end(),
                                     [&](const CadFace& face) { return face.solid == static_cast<int>(s); });
    text += fmt::format("  {} {}{}: {} face{}{}\n", solid.closed ? "solid" : "sheet", s + 1,
                        named(solid.name), faces, plural(faces), coloured(solid.colour));
  }
  return text;
}

// What a face is, in figures.
std::string shape_text(const CadModel& model, const CadFace& face) {
  const brep::Face& s = face.shape;
  constexpr double kDegree = 180.0 / nurbs::kPi;
  switch (s.kind) {
    case brep::Kind::cylinder:
    case brep::Kind::sphere:
      return fmt::format(", radius {:.9g}", s.R);
    case brep::Kind::cone:
      return fmt::format(", half angle {:.9g} degrees", kDegree * s.r);
    case brep::Kind::torus:
      return fmt::format(", radii {:.9g} and {:.9g}", s.R, s.r);
    case brep::Kind::nurbs: {
      const auto& space = model.patches[s.patch].space;
      return fmt::format(", degrees {} x {}, {} x {} elements{}", space.degree(0), space.degree(1),
                         space.knots(0).element_count(), space.knots(1).element_count(),
                         space.rational() ? ", rational" : "");
    }
    default:
      return "";
  }
}

std::string faces_text(const CadModel& model) {
  std::array<int, kKinds.size()> count{};
  double whole = 0.0;
  std::string lines;
  for (const CadFace& face : model.faces) {
    const double area = area_of(model, face);
    whole += area;
    ++count[static_cast<int>(face.shape.kind)];
    lines += fmt::format("  face:{}{} {}, area {:.9g}{}{}{}\n", face.number, named(face.name),
                         kKinds[static_cast<int>(face.shape.kind)], area, shape_text(model, face),
                         coloured(face.colour),
                         face.loops.size() > 1 ? fmt::format(", {} borders", face.loops.size()) : "");
  }
  std::string kinds;
  for (size_t k = 0; k < kKinds.size(); ++k)
    if (count[k] > 0) kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", count[k], kKinds[k]);
  return fmt::format("faces: {} ({}), area {:.9g}\n", model.faces.size(), kinds, whole) + lines;
}

std::string edges_text(const CadModel& model) {
  std::array<int, 5> count{};
  double gap = 0.0, tolerance = 0.0;
  size_t widest = 0;
  const std::vector<EdgeMeasure> measures = measured_edges(model);
  for (size_t e = 0; e < measures.size(); ++e) {
    ++count[static_cast<int>(measures[e].kind)];
    if (measures[e].gap > gap) gap = measures[e].gap, widest = e;
  }
  for (const CadFace& face : model.faces) tolerance = std::max(tolerance, face.tolerance);
  for (const brep::CadEdge& edge : model.edges) tolerance = std::max(tolerance, edge.tolerance);
  for (const brep::CadVertex& vertex : model.vertices) tolerance = std::max(tolerance, vertex.tolerance);
  std::string text = fmt::format(
      "edges: {}: {} smooth (up to {} rad), {} near-tangent (up to {}), {} sharp, {} free", measures.size(),
      count[static_cast<int>(EdgeMeasure::Kind::smooth)], kSmoothAngle,
      count[static_cast<int>(EdgeMeasure::Kind::near_tangent)], kNearTangentAngle,
      count[static_cast<int>(EdgeMeasure::Kind::sharp)], count[static_cast<int>(EdgeMeasure::Kind::free)]);
  if (count[static_cast<int>(EdgeMeasure::Kind::many)] > 0)
    text += fmt::format(", {} of more than two faces", count[static_cast<int>(EdgeMeasure::Kind::many)]);
  text += fmt::format("\n  largest gap between a face's border and its edge: {:.3g}", gap);
  if (gap > 0.0) text += fmt::format(" (edge {})", widest + 1);
  return text + fmt::format("; largest tolerance in the file: {:.3g}\n", tolerance);
}

}  // namespace

std::string cad_text(const CadModel& model) {
  const auto bodies = std::count_if(model.solids.begin(), model.solids.end(),
                                    [](const brep::CadSolid& s) { return s.closed; });
  const auto sheets = static_cast<std::ptrdiff_t>(model.solids.size()) - bodies;
  std::string text =
      fmt::format("CAD file in {}: {} solid{}, {} sheet{}\n", model.unit.empty() ? "no unit" : model.unit,
                  bodies, plural(bodies), sheets, plural(sheets));
  text += solids_text(model) + faces_text(model) + edges_text(model);
  text += model.healed.empty() ? "healed: nothing\n" : "healed:\n";
  for (const std::string& line : model.healed) text += "  " + line + "\n";
  return text + "refused: nothing\n";
}

}  // namespace geometry_io

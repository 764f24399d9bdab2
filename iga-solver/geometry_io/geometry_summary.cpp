// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/geometry_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "brep/surface.h"
#include "geometry_io/cad_summary.h"
#include "geometry_io/triangle_summary.h"
#include "nurbs/borders.h"
#include "nurbs/gauss_legendre.h"

namespace geometry_io {
namespace {

using nurbs::Border;
using nurbs::KnotVector;
using nurbs::Patch;
using nurbs::RationalBasis;
using nurbs::Surface;
using nurbs::Vector3;
using nurbs::Volume;

constexpr const char* kDirections[] = {"xi", "eta", "zeta"};
constexpr double kDegreesPerRadian = 57.29577951308232;
constexpr double kSmooth = 1e-6;  // angle [rad] and relative jump below which a border is called G1 and C1

template <int Dim>
using Tangents = std::array<Vector3, Dim>;

template <int Dim>
Tangents<Dim> tangents(const Patch<Dim>& patch, int element, const nurbs::Parameter<Dim>& xi) {
  RationalBasis<Dim> basis;
  evaluate_on_element(patch.space, element, xi, 1, basis);
  Tangents<Dim> S;
  for (int d = 0; d < Dim; ++d) {
    S[d].setZero();
    for (int a = 0; a < basis.count; ++a)
      S[d] += basis.dR[d][a] * patch.control_points.col(basis.control_point[a]);
  }
  return S;
}

double measure(const Tangents<2>& S) { return S[0].cross(S[1]).norm(); }
double measure(const Tangents<3>& S) { return S[0].dot(S[1].cross(S[2])); }

// Area or volume by Gauss quadrature, exact for polynomial volumes.
template <int Dim>
double measure(const Patch<Dim>& patch) {
  double sum = 0.0;
  for (int e = 0; e < patch.space.element_count(); ++e) {
    const nurbs::Indices<Dim> indices = patch.space.element_indices(e);
    nurbs::QuadratureRule rules[Dim];
    int count = 1;
    for (int d = 0; d < Dim; ++d) {
      const KnotVector& knots = patch.space.knots(d);
      const int points = std::min(knots.degree() + 3, nurbs::kMaxGaussPoints);
      rules[d] = nurbs::gauss_legendre(points, knots.breaks()[indices[d]], knots.breaks()[indices[d] + 1]);
      count *= points;
    }
    for (int point = 0; point < count; ++point) {
      nurbs::Parameter<Dim> xi;
      double weight = 1.0;
      for (int d = 0, rest = point; d < Dim; ++d) {
        const int n = static_cast<int>(rules[d].points.size());
        xi[d] = rules[d].points[rest % n];
        weight *= rules[d].weights[rest % n];
        rest /= n;
      }
      sum += weight * measure(tangents(patch, e, xi));
    }
  }
  return sum;
}

double largest_kink(const Volume&, int) { return 0.0; }
using nurbs::largest_kink;

// "3 C0, 2 C1": how many interior knots of each continuity.
std::string continuity(const KnotVector& knots) {
  std::map<int, int> count;
  for (int e = 1; e < knots.element_count(); ++e)
    ++count[knots.degree() - (knots.span_of_element(e) - knots.span_of_element(e - 1))];
  std::vector<std::string> parts;
  for (const auto& [order, number] : count) parts.push_back(fmt::format("{} C{}", number, order));
  return parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "));
}

std::string box_text(const Vector3& low, const Vector3& high) {
  return fmt::format("x {:.6g} to {:.6g}, y {:.6g} to {:.6g}, z {:.6g} to {:.6g}", low[0], high[0], low[1],
                     high[1], low[2], high[2]);
}

template <int Dim>
std::string patch_text(const Patch<Dim>& patch) {
  std::vector<int> degrees, points, elements;
  for (int d = 0; d < Dim; ++d) {
    degrees.push_back(patch.space.degree(d));
    points.push_back(patch.space.control_point_count(d));
    elements.push_back(patch.space.knots(d).element_count());
  }
  std::string text =
      fmt::format("{}, degrees {}, {} control points, {} elements, {}\n", Dim == 2 ? "surface" : "volume",
                  fmt::join(degrees, " "), fmt::join(points, " x "), fmt::join(elements, " x "),
                  patch.space.rational() ? "rational" : "polynomial");
  // A rational arc's control points lie outside of it: the extents are those of the control points.
  const Vector3 low = patch.control_points.rowwise().minCoeff(),
                high = patch.control_points.rowwise().maxCoeff();
  text += "  control points within " + box_text(low, high) + '\n';
  text += fmt::format("  {} {:.6g}\n", Dim == 2 ? "area" : "volume", measure(patch));
  for (int d = 0; d < Dim; ++d) {
    text += fmt::format("  interior knots of {}: {}", kDirections[d], continuity(patch.space.knots(d)));
    if (Dim == 2 && patch.space.knots(d).creases().size() > 2)
      text += fmt::format(", largest angle at C0 {:.3g} degrees", kDegreesPerRadian * largest_kink(patch, d));
    text += '\n';
  }
  return text;
}

std::string patch_text(const geometry_io::TriangleMesh& mesh) {
  const Vector3 low = mesh.points.rowwise().minCoeff(), high = mesh.points.rowwise().maxCoeff();
  return fmt::format("{} triangles{}, {} points within {}\n", mesh.count(),
                     mesh.name.empty() ? "" : fmt::format(" of the solid '{}'", mesh.name),
                     mesh.points.cols(), box_text(low, high));
}

std::string border_text(const Border& border, int own_patch, int side,
                        const std::vector<std::string>& names) {
  if (border.kind == Border::free) return "free";
  if (border.kind == Border::pole) return "pole";
  std::string text =
      border.patch == own_patch ? "closed with its " : "welded to " + names[border.patch] + " ";
  text += nurbs::side_name(border.side);
  if (border.reversed) text += " reversed";
  if (!same_orientation(side, border)) text += ", opposite orientation";
  const bool G1 = border.max_angle <= kSmooth, C1 = G1 && border.max_jump <= kSmooth;
  return text + fmt::format(", {}, largest angle {:.3g} degrees",
                            C1   ? "C1"
                            : G1 ? "G1"
                                 : "C0",
                            kDegreesPerRadian * border.max_angle);
}

std::string borders_text(const std::vector<Surface>& patches, const std::vector<std::string>& names) {
  const auto borders = nurbs::find_borders(patches);
  std::string text;
  for (int p = 0; p < static_cast<int>(patches.size()); ++p)
    for (int side = 0; side < nurbs::kSideCount; ++side)
      text += fmt::format("  {} {}: {}\n", names[p], nurbs::side_name(side),
                          border_text(borders[p][side], p, side, names));
  return text;
}

}  // namespace

std::string summary(const GeometryFile& geometry) { return summary(geometry, brep::kEdgeAngle); }

std::string summary(const GeometryFile& geometry, double edge_angle) {
  if (geometry.cad) return cad_text(*geometry.cad);
  std::string text;
  std::vector<Surface> surfaces;
  std::vector<std::string> names;
  for (size_t p = 0; p < geometry.patches.size(); ++p) {
    const std::string name = fmt::format("patch {}", p);
    text +=
        name + ": " + std::visit([](const auto& patch) { return patch_text(patch); }, geometry.patches[p]);
    if (const auto* surface = std::get_if<Surface>(&geometry.patches[p])) {
      surfaces.push_back(*surface);
      names.push_back(name);
    }
  }
  if (!surfaces.empty()) text += "borders\n" + borders_text(surfaces, names);
  text += triangles_text(geometry, edge_angle);
  for (const auto& [name, pieces] : geometry.surfaces) {
    text += fmt::format("surface '{}': {}\n", name, fmt::join(surface_words(pieces, geometry.patches), ", "));
    if (!std::any_of(pieces.begin(), pieces.end(), [](const auto& piece) { return piece.face.has_value(); }))
      continue;
    surfaces.clear();
    names.clear();
    for (const SurfacePiece& piece : pieces) {
      if (is_triangles(geometry.patches[piece.patch])) continue;
      surfaces.push_back(extract(piece, geometry.patches).surface);
      names.push_back(surface_words({piece}, geometry.patches).front());
    }
    text += borders_text(surfaces, names);
  }
  return text;
}

}  // namespace geometry_io

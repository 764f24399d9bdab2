// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/summary.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

namespace brep {
namespace {

constexpr double kNearSmooth = 1e-3;  // [rad]

// Area, and the flux of x / 3 through it, which sums up to the volume.
struct Content {
  double area, flux;
};

// |dS/dxi0 x dS/dxi1|.
double stretch(const Face& face, double second) {
  switch (face.kind) {
    case Kind::cylinder:
      return face.R;
    case Kind::cone:
      return second * std::sin(face.r);
    case Kind::sphere:
      return face.R * face.R * std::cos(second);
    case Kind::torus:
      return face.r * (face.R + face.r * std::cos(second));
    default:
      return 1.0;
  }
}

Content content_of(const Surface& surface, const Piece& piece, const Vector3& from) {
  const Face& face = surface.faces[piece.face];
  if (piece.triangle()) {
    const Vector3 &a = surface.vertices[piece.vertex[0]].point, &b = surface.vertices[piece.vertex[1]].point,
                  &c = surface.vertices[piece.vertex[2]].point;
    return {0.5 * (b - a).cross(c - a).norm(), (a - from).dot((b - from).cross(c - from)) / 6.0};
  }
  constexpr int kPoints = 64;  // the midpoint rule: exact round whole turns, to 1e-4 elsewhere
  Content content{0.0, 0.0};
  const double step[2] = {(face.high[0] - face.low[0]) / kPoints, (face.high[1] - face.low[1]) / kPoints};
  for (int i = 0; i < kPoints; ++i)
    for (int j = 0; j < kPoints; ++j) {
      const Parameter<2> xi{face.low[0] + (i + 0.5) * step[0], face.low[1] + (j + 0.5) * step[1]};
      const double area = stretch(face, xi[1]) * step[0] * step[1];
      content.area += area;
      content.flux += area * face.normal(xi).dot(face.point(xi) - from) / 3.0;
    }
  return content;
}

void count_edge(const Surface& surface, const Edge& edge, Summary& summary) {
  const EdgeUse* use = &surface.uses[edge.first_use];
  if (edge.use_count == 1) {
    ++summary.free;
    summary.free_length += edge.line() ? edge.length : edge.R * edge.length;
    return;
  }
  if (edge.use_count > 2) {
    ++summary.many;
    return;
  }
  if (joins(use[0].wedge) && joins(use[1].wedge)) {
    const double turned = std::abs(
        std::atan2(use[0].conormal[0] * use[1].conormal[1] - use[0].conormal[1] * use[1].conormal[0],
                   use[0].conormal[0] * use[1].conormal[0] + use[0].conormal[1] * use[1].conormal[1]));
    ++(nurbs::kPi - turned <= kNearSmooth ? summary.smooth : summary.near_smooth);
    return;
  }
  const Wedge seen = use[0].side > 0 ? use[0].wedge : use[1].wedge;
  ++(seen == Wedge::convex ? summary.convex : summary.concave);
}

// Whether the + sides of all faces that meet see one another.
bool turned_alike(const Surface& surface, const Edge& edge) {
  const EdgeUse* use = &surface.uses[edge.first_use];
  return edge.use_count == 2 && use[0].side == -use[1].side;
}

}  // namespace

Summary summary_of(const Surface& surface) {
  Summary summary;
  for (const Face& face : surface.faces) ++summary.faces[static_cast<int>(face.kind)];
  summary.pieces = static_cast<int>(surface.pieces.size());
  for (const Vertex& vertex : surface.vertices) summary.vertices += vertex.corner_count > 0;
  summary.sheets = surface.sheet_count;
  bool alike = true;
  for (const Edge& edge : surface.edges) {
    count_edge(surface, edge, summary);
    alike = alike && turned_alike(surface, edge);
  }
  summary.closed = summary.free == 0;
  const Vector3 middle = 0.5 * (surface.low + surface.high);
  double volume = 0.0;
  for (const Piece& piece : surface.pieces) {
    if (surface.trimmed()) break;
    const Content content = content_of(surface, piece, middle);
    summary.area += content.area;
    volume += content.flux;
  }
  if (summary.closed && alike) summary.volume = volume;
  return summary;
}

std::string text_of(const Surface& surface) {
  constexpr const char* kNames[] = {"plane", "cylinder", "cone", "sphere", "torus", "spline"};
  const Summary summary = summary_of(surface);
  std::string kinds;
  for (int k = 0; k < 6; ++k)
    if (summary.faces[k] > 0)
      kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", summary.faces[k], kNames[k]);
  return fmt::format(
      "  {} faces ({}), from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})\n"
      "  {} edges: {} smooth, {} convex, {} concave, {} free, {} of more than two faces\n",
      surface.faces.size(), kinds, surface.low[0], surface.low[1], surface.low[2], surface.high[0],
      surface.high[1], surface.high[2], surface.edges.size(), summary.smooth + summary.near_smooth,
      summary.convex, summary.concave, summary.free, summary.many);
}

}  // namespace brep

// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/summary.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "brep/disjoint_sets.h"

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

/// Which faces hang together.
int number_shells(const Surface& surface, std::vector<int>& of_face) {
  DisjointSets sets(static_cast<int>(surface.faces.size()));
  for (const Edge& edge : surface.edges)
    for (int k = 1; k < edge.use_count; ++k)
      sets.join(surface.uses[edge.first_use].face, surface.uses[edge.first_use + k].face);
  return sets.number(of_face);
}

struct SeenTriangle {
  const Vector3 &a, &b, &c;
  SeenTriangle(const Surface& surface, const Piece& piece)
      : a(surface.vertices[piece.vertex[0]].point),
        b(surface.vertices[piece.vertex[1]].point),
        c(surface.vertices[piece.vertex[2]].point) {}
  Vector3 middle() const { return (a + b + c) / 3.0; }
};

// Of a triangle, as seen from a point.  Source: van Oosterom & Strackee (1983), IEEE Trans. Biomed. Eng. 30,
// 125-126.
double solid_angle(const SeenTriangle& triangle, const Vector3& from) {
  const Vector3 a = triangle.a - from, b = triangle.b - from, c = triangle.c - from;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

struct ShellPieces {
  Shell shell{Vector3::Constant(HUGE_VAL), Vector3::Constant(-HUGE_VAL)};
  std::vector<const Piece*> pieces = {};

  bool encloses(const Surface& surface, const Vector3& point) const {
    if ((point.array() < shell.low.array()).any() || (point.array() > shell.high.array()).any()) return false;
    double angle = 0.0;
    for (const Piece* piece : pieces) angle += solid_angle(SeenTriangle(surface, *piece), point);
    return std::abs(angle) > 2.0 * nurbs::kPi;
  }
};

/// Normals point away from what is enclosed: inwards on a shell in an odd number of others, a cavity.
std::vector<Shell> shells_of(const Surface& surface) {
  std::vector<int> of_face;
  std::vector<ShellPieces> all(number_shells(surface, of_face));
  for (const Piece& piece : surface.pieces) {
    if (!piece.triangle()) return {};
    ShellPieces& own = all[of_face[piece.face]];
    own.pieces.push_back(&piece);
    for (const int vertex : piece.vertex) {
      own.shell.low = own.shell.low.cwiseMin(surface.vertices[vertex].point);
      own.shell.high = own.shell.high.cwiseMax(surface.vertices[vertex].point);
    }
  }
  std::vector<Shell> shells;
  for (const ShellPieces& own : all) {
    Shell shell = own.shell;
    for (const Piece* piece : own.pieces) shell.volume += content_of(surface, *piece, shell.low).flux;
    const Vector3 point = SeenTriangle(surface, *own.pieces.front()).middle();
    const auto around = std::count_if(all.begin(), all.end(), [&](const ShellPieces& other) {
      return &other != &own && other.encloses(surface, point);
    });
    shell.inside_out = (around % 2 == 1) != (shell.volume < 0.0);
    shells.push_back(shell);
  }
  return shells;
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
  if (!summary.closed || !alike) return summary;
  summary.volume = volume;
  if (!surface.trimmed()) summary.shells = shells_of(surface);
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

// SPDX-License-Identifier: GPL-2.0-or-later
#include "cad_of_wall.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "brep/closed_form.h"
#include "brep/sides.h"
#include "nurbs/primitives.h"

namespace brep::trials {
namespace {

Spline<2> line(const Parameter<2>& from, const Parameter<2>& to) {
  Spline<2> spline;
  spline.knots = {0.0, 0.0, 1.0, 1.0};
  spline.points.resize(2, 2);
  spline.points << from[0], to[0], from[1], to[1];
  return spline;
}

CadEdge cad_edge(const Edge& edge) {
  CadEdge given;
  given.kind = edge.line() ? CadEdge::Kind::line : CadEdge::Kind::circle;
  given.origin = edge.origin, given.axis = edge.axis, given.radial = edge.radial;
  given.R = edge.R;
  given.length = edge.length;
  for (int k = 0; k < 2; ++k) given.vertex[k] = edge.vertex[k];
  return given;
}

class CadOfWall {
 public:
  explicit CadOfWall(const Surface& wall) : wall_(wall) {
    for (const Vertex& vertex : wall.vertices) model_.vertices.push_back({vertex.point});
    for (const Edge& edge : wall.edges) model_.edges.push_back(cad_edge(edge));
    cut_circles();
    for (int f = 0; f < static_cast<int>(wall.faces.size()); ++f) {
      CadFace face;
      face.shape = wall.faces[f];
      face.shape.first_piece = face.shape.piece_count = 0;
      face.number = f + 1;
      model_.faces.push_back(face);
      if (wall.pieces[wall.faces[f].first_piece].triangle())
        add_polygons(f);
      else
        add_rectangle(f);
    }
  }

  CadModel model() { return std::move(model_); }

 private:
  Parameter<2> on_plane(int f, const Vector3& point) const {
    const Frame& frame = wall_.faces[f].frame;
    return {frame.x.dot(point - frame.origin), frame.y.dot(point - frame.origin)};
  }

  // Loops from corner to corner: at each an edge arrives and another one leaves.
  void add_polygons(int f) {
    std::map<int, int> leaves;  // use of the edge that arrives to use of that which leaves
    std::map<int, std::pair<int, int>> ends;
    for (int v = 0; v < static_cast<int>(wall_.vertices.size()); ++v) {
      const Vertex& vertex = wall_.vertices[v];
      for (int c = vertex.first_corner; c < vertex.first_corner + vertex.corner_count; ++c) {
        const Corner& corner = wall_.corners[c];
        if (corner.face != f) continue;
        leaves[corner.ray[1] / 2] = corner.ray[0] / 2;
        ends[corner.ray[0] / 2].first = v;
        ends[corner.ray[1] / 2].second = v;
      }
    }
    while (!leaves.empty()) {
      Loop loop;
      for (auto at = leaves.begin(); at != leaves.end();) {
        const int use = at->second;
        leaves.erase(at);
        const auto [from, to] = ends[use];
        const int edge = wall_.uses[use].edge;
        loop.push_back({line(on_plane(f, wall_.vertices[from].point), on_plane(f, wall_.vertices[to].point)),
                        edge, wall_.edges[edge].vertex[0] == from});
        at = leaves.find(use);
      }
      model_.faces[f].loops.push_back(loop);
    }
  }

  int vertex_at(const Vector3& point) {
    for (size_t v = 0; v < model_.vertices.size(); ++v)
      if ((model_.vertices[v].point - point).norm() < 1e-9 * wall_.size) return static_cast<int>(v);
    model_.vertices.push_back({point});
    return static_cast<int>(model_.vertices.size()) - 1;
  }

  void add_rectangle(int f) {
    const Face& face = wall_.faces[f];
    const Piece& piece = wall_.pieces[face.first_piece];
    const Borders& borders = wall_.borders[piece.borders()];
    Loop loop;
    int seams[2] = {-1, -1};
    for (int i = 0; i < 4; ++i) {
      const Parameter<2> from = corner_parameters(face, i), to = corner_parameters(face, (i + 1) % 4);
      Trim trim{line(from, to), -1, true};
      if (borders.use[i] >= 0) {
        add_border(face, i, wall_.uses[borders.use[i]].edge, loop);
        continue;
      } else if ((face.point(from) - face.point({0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])})).norm() >
                 1e-9 * wall_.size) {  // else a pole
        int& seam = seams[i % 2];
        trim.forward = seam < 0;
        if (seam < 0) seam = add_seam(f, i);
        trim.edge = seam;
      }
      loop.push_back(trim);
    }
    model_.faces[f].loops.push_back(loop);
  }

  // Where a closed edge meets the seams of its faces.
  void cut_circles() {
    for (const Piece& piece : wall_.pieces) {
      if (!piece.rectangle()) continue;
      const Face& face = wall_.faces[piece.face];
      for (int i = 0; i < 4; ++i) {
        const int use = wall_.borders[piece.borders()].use[i];
        if (use < 0 || !wall_.edges[wall_.uses[use].edge].closed()) continue;
        cuts_[wall_.uses[use].edge].insert(vertex_at(face.point(corner_parameters(face, i))));
      }
    }
    for (const auto& [number, vertices] : cuts_) {
      const Edge& circle = wall_.edges[number];
      std::vector<std::pair<double, int>> along;
      for (const int v : vertices) along.emplace_back(angle_on(circle, model_.vertices[v].point), v);
      std::sort(along.begin(), along.end());
      for (size_t k = 0; k < along.size(); ++k) {
        const auto [begin, from] = along[k];
        const auto [end, to] = along[(k + 1) % along.size()];
        CadEdge arc = cad_edge(circle);
        arc.radial = (circle.point(begin) - circle.origin).normalized();
        arc.length = end > begin ? end - begin : end + 2.0 * nurbs::kPi - begin;
        arc.vertex[0] = from, arc.vertex[1] = to;
        arcs_[number].push_back(static_cast<int>(model_.edges.size()));
        model_.edges.push_back(arc);
      }
    }
  }

  static double angle_on(const Edge& circle, const Vector3& point) {
    const Vector3 from = point - circle.origin;
    const double angle = std::atan2(from.dot(circle.axis.cross(circle.radial)), from.dot(circle.radial));
    return angle < -1e-9 ? angle + 2.0 * nurbs::kPi : angle;
  }

  // Side i of a face, in as many parts as its edge has.
  void add_border(const Face& face, int i, int edge, Loop& loop) {
    const Parameter<2> from = corner_parameters(face, i), to = corner_parameters(face, (i + 1) % 4);
    if (arcs_.count(edge) == 0) return add_part(face, from, to, edge, loop);
    std::vector<double> at{0.0, 1.0};  // of the way from corner to corner
    for (const int v : cuts_[edge]) {
      const double share =
          (face.project(model_.vertices[v].point).xi[i % 2] - from[i % 2]) / (to[i % 2] - from[i % 2]);
      if (share > 1e-9 && share < 1.0 - 1e-9) at.push_back(share);
    }
    std::sort(at.begin(), at.end());
    const auto on_way = [&](double share) {
      return Parameter<2>{from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])};
    };
    for (size_t k = 0; k + 1 < at.size(); ++k) {
      const Vector3 middle = face.point(on_way(0.5 * (at[k] + at[k + 1])));
      const auto holds = [&](int arc) {
        const CadEdge& given = model_.edges[arc];
        Edge curve = wall_.edges[edge];
        curve.radial = given.radial;
        return angle_on(curve, middle) <= given.length;
      };
      add_part(face, on_way(at[k]), on_way(at[k + 1]),
               *std::find_if(arcs_[edge].begin(), arcs_[edge].end(), holds), loop);
    }
  }

  void add_part(const Face& face, const Parameter<2>& from, const Parameter<2>& to, int edge, Loop& loop) {
    const auto at = [&](double share) {
      return face.point({from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])});
    };
    loop.push_back({line(from, to), edge, runs_along(model_.edges[edge], at(0.1), at(0.2))});
  }

  static bool runs_along(const CadEdge& edge, const Vector3& first, const Vector3& second) {
    if (edge.kind == CadEdge::Kind::line) return edge.axis.dot(second - first) > 0.0;
    return edge.axis.dot((first - edge.origin).cross(second - edge.origin)) > 0.0;
  }

  int add_seam(int f, int side) {
    CadEdge edge = cad_edge(curve_of(wall_, side_number(wall_.faces[f].first_piece, side)));
    const Edge curve = curve_of(wall_, side_number(wall_.faces[f].first_piece, side));
    edge.vertex[0] = vertex_at(curve.point(0.0));
    edge.vertex[1] = vertex_at(curve.point(curve.length));
    model_.edges.push_back(edge);
    return static_cast<int>(model_.edges.size()) - 1;
  }

  const Surface& wall_;
  CadModel model_;
  std::map<int, std::set<int>> cuts_;     // vertices on closed edges
  std::map<int, std::vector<int>> arcs_;  // of the model, in place of these
};

// A patch of the same shape, over the range of parameters.
nurbs::Surface patch_of(const Face& face) {
  const nurbs::Frame frame{face.frame.origin,
                           (Eigen::Matrix3d() << face.frame.x, face.frame.y, face.frame.z).finished()};
  const double degree = 180.0 / nurbs::kPi;
  const auto arc = [&](int i) {
    const nurbs::Curve plain = nurbs::arc(degree * face.low[i], degree * face.high[i]);
    return nurbs::refined(plain, 2 * plain.space.element_count(), 2);
  };
  const nurbs::KnotVector along = nurbs::KnotVector::uniform(2, 3);
  nurbs::Frame low = frame;
  switch (face.kind) {
    case Kind::cylinder:
      low.origin = frame.origin + face.low[1] * face.frame.z;
      return nurbs::cylinder(low, face.R, face.high[1] - face.low[1], arc(0), along);
    case Kind::cone:
      low.origin = frame.origin + face.low[1] * std::cos(face.r) * face.frame.z;
      return nurbs::cone(low, {face.low[1] * std::sin(face.r), face.high[1] * std::sin(face.r)},
                         (face.high[1] - face.low[1]) * std::cos(face.r), arc(0), along);
    case Kind::sphere:
      return nurbs::sphere(frame, face.R, arc(0), arc(1));
    case Kind::torus:
      return nurbs::torus(frame, face.R, face.r, arc(0), arc(1));
    default: {
      const double u = face.high[0] - face.low[0], v = face.high[1] - face.low[1];
      return nurbs::plane(face.point(face.low), u * face.frame.x, v * face.frame.y, {along, along});
    }
  }
}

// Lines along one parameter, and all on planes, stay lines.
void make_patch(CadFace& face, CadModel& model) {
  Face shape = face.shape;
  shape.low = {1e300, 1e300}, shape.high = {-1e300, -1e300};
  for (const Loop& loop : face.loops)
    for (const Trim& trim : loop)
      for (int k = 0; k < 2; ++k)
        for (int i = 0; i < 2; ++i) {
          shape.low[i] = std::min(shape.low[i], trim.curve.points(i, k));
          shape.high[i] = std::max(shape.high[i], trim.curve.points(i, k));
        }
  model.patches.push_back(patch_of(shape));
  const nurbs::Surface& patch = model.patches.back();
  const auto arcs = [](double angle) {
    return static_cast<int>(std::ceil(angle / (0.5 * nurbs::kPi) - 1e-9));
  };
  std::vector<ChartLine> chart;
  for (int i = 0; i < 2; ++i) {
    const bool angle =
        shape.kind == Kind::torus || shape.kind == Kind::sphere || (shape.kind != Kind::plane && i == 0);
    chart.emplace_back(std::array<double, 2>{shape.low[i], shape.high[i]},
                       std::array<double, 2>{patch.space.knots(i).front(), patch.space.knots(i).back()},
                       angle ? arcs(shape.high[i] - shape.low[i]) : 0);
  }
  for (Loop& loop : face.loops)
    for (Trim& trim : loop)
      for (int k = 0; k < 2; ++k)
        for (int i = 0; i < 2; ++i) trim.curve.points(i, k) = chart[i].to_patch(trim.curve.points(i, k));
  face.shape.kind = Kind::nurbs;
  face.shape.patch = static_cast<int>(model.patches.size()) - 1;
}

}  // namespace

CadModel cad_of(const Surface& wall, bool as_patches) {
  CadModel model = CadOfWall(wall).model();
  if (as_patches)
    for (CadFace& face : model.faces) make_patch(face, model);
  return model;
}

}  // namespace brep::trials

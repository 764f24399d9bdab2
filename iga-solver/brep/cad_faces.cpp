// SPDX-License-Identifier: GPL-2.0-or-later
// From the faces of a CAD file to a wall.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "brep/assembly.h"
#include "brep/bounds.h"
#include "brep/builder.h"
#include "brep/disjoint_sets.h"
#include "brep/edge_uses.h"

namespace brep {
namespace {

constexpr double kExact = 1e-9;      // of the size: how far apart borders are that meet
constexpr double kConstant = 1e-10;  // of conormals along an edge: those of one place are those of all
constexpr int kLooksAlong = 9;       // at an edge, to see what it is like along its way
constexpr double kMostTurn = 0.25;   // of a chunk of a spline [rad]

// How a curve turns at most: the sum of the angles of its polygon.
double turn_of(const BezierCurve<3>& curve) {
  double turned = 0.0;
  Vector3 last = Vector3::Zero();
  for (int k = 0; k < curve.degree(); ++k) {
    const Vector3 leg = curve.point(k + 1) - curve.point(k);
    if (leg.norm() == 0.0) continue;
    if (!last.isZero(0.0)) turned += std::atan2(last.cross(leg).norm(), last.dot(leg));
    last = leg;
  }
  return turned;
}

void add_chunks(const BezierCurve<3>& curve, std::vector<Chunk>& chunks) {
  if (turn_of(curve) > kMostTurn && curve.end - curve.begin > 0.0) {
    const auto [before, behind] = curve.parts(0.5);
    add_chunks(before, chunks);
    return add_chunks(behind, chunks);
  }
  const auto begin = curve.derivatives(0.0), end = curve.derivatives(1.0);
  Chunk chunk{
      curve, Vector3::Zero(), curve.at(0.5), 0.0, 0.0, {{begin.point, begin.first}, {end.point, end.first}}};
  for (int k = 0; k <= curve.degree(); ++k) {
    chunk.radius = std::max(chunk.radius, (curve.point(k) - chunk.centre).norm());
    chunk.bulge = std::max(chunk.bulge, chunk.distance_of_chord(curve.point(k)));
  }
  chunks.push_back(chunk);
}

class FromCad {
 public:
  FromCad(const CadModel& model, const std::vector<int>& faces, double edge_angle) : model_(model) {
    if (faces.empty()) throw std::invalid_argument("faces: there are none");
    surface_.edge_angle = edge_angle;
    if (!model.patches.empty())
      surface_.patches = std::make_shared<const PatchFaces>(model.patches, edge_angle);
    for (const int f : faces) add_face(model.faces.at(f));
    measure();
    for (const int f : faces) add_trims(model.faces[f]);
    add_edges();
    make_sheets(surface_);
    join_sheets_along_edges();
    add_corners();
    add_pieces();
  }

  Surface surface() { return std::move(surface_); }

 private:
  struct TrimOf {
    int face, edge;  // of the wall, and of the model
    bool forward;
    const Trim* trim;
    int use = -1;
  };

  void add_face(const CadFace& given) {
    try {
      Face face = given.shape;
      surface_.domains.emplace_back(given.loops);
      face.low = surface_.domains.back().low();
      face.high = surface_.domains.back().high();
      face.outward = given.outward;
      surface_.faces.push_back(face);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("face {}: {}", given.number, error.what()));
    }
  }

  void measure() {
    surface_.low.setConstant(1e300);
    surface_.high.setConstant(-1e300);
    std::vector<Bounds> boxes;
    for (size_t f = 0; f < surface_.faces.size(); ++f) {
      const Face& face = surface_.faces[f];
      if (face.kind != Kind::nurbs) {
        add_boxes(surface_, {static_cast<int>(f), {}, {}, Piece::Kind::trimmed}, boxes);
        continue;
      }
      for (int e = 0; e < surface_.patches->patch(face.patch).space.element_count(); ++e)
        if (is_in(static_cast<int>(f), e))
          add_boxes(surface_, {static_cast<int>(f), {}, {e, -1, -1}, Piece::Kind::element}, boxes);
    }
    for (const Bounds& box : boxes) {
      surface_.low = surface_.low.cwiseMin(box.low);
      surface_.high = surface_.high.cwiseMax(box.high);
    }
    surface_.size = (surface_.high - surface_.low).norm();
    surface_.slack = 2.0 * kExact * surface_.size;
  }

  // Whether there is something of a face on an element of its patch.
  bool is_in(int f, int element) const {
    const nurbs::Space<2>& space = surface_.patches->patch(surface_.faces[f].patch).space;
    const nurbs::Indices<2> e = space.element_indices(element);
    Parameter<2> low, high;
    for (int i = 0; i < 2; ++i) {
      low[i] = space.knots(i).breaks()[e[i]];
      high[i] = space.knots(i).breaks()[e[i] + 1];
    }
    return surface_.domains[f].where(low, high) != TrimDomain::Where::outside;
  }

  void add_trims(const CadFace& face) {
    for (const Loop& loop : face.loops) {
      first_of_loop_.push_back(static_cast<int>(trims_.size()));
      for (const Trim& trim : loop) {
        trims_.push_back({faces_done_, trim.edge, trim.forward, &trim});
        if (trim.edge < 0 && face.shape.kind == Kind::nurbs) add_pole(face.shape.patch, trim);
      }
    }
    ++faces_done_;
  }

  void add_pole(int patch, const Trim& trim) {
    const std::vector<BezierCurve<2>> curves = beziers(trim.curve);
    const Eigen::Vector2d from = curves.front().at(0.0), to = curves.back().at(1.0);
    const Parameter<2> start{from[0], from[1]};
    surface_.poles.push_back({faces_done_, start, {to[0], to[1]}, surface_.patches->point(patch, start)});
  }

  void add_edges() {
    std::map<int, std::vector<int>> trims_of;
    for (size_t k = 0; k < trims_.size(); ++k)
      if (trims_[k].edge >= 0) trims_of[trims_[k].edge].push_back(static_cast<int>(k));
    for (const auto& [cad_edge, trims] : trims_of) add_edge(model_.edges.at(cad_edge), trims);
  }

  int vertex(int of_model) {
    const auto [found, is_new] = vertices_.try_emplace(of_model, static_cast<int>(surface_.vertices.size()));
    if (is_new) surface_.vertices.push_back({model_.vertices.at(of_model).point, 0, 0});
    return found->second;
  }

  void add_edge(const CadEdge& given, const std::vector<int>& trims) {
    Edge edge{};
    edge.origin = given.origin, edge.axis = given.axis, edge.radial = given.radial;
    edge.length = given.length;
    edge.R = given.kind == CadEdge::Kind::circle ? given.R : 0.0;
    for (int k = 0; k < 2; ++k) edge.vertex[k] = vertex(given.vertex[k]);
    edge.first_use = static_cast<int>(surface_.uses.size());
    edge.use_count = static_cast<int>(trims.size());
    if (given.kind == CadEdge::Kind::spline) add_spline(given.curve, edge);
    const int number = static_cast<int>(surface_.edges.size());
    for (const int k : trims) {
      trims_[k].use = static_cast<int>(surface_.uses.size());
      EdgeUse use{};
      use.face = trims_[k].face;
      use.edge = number;
      use.along = trims_[k].forward ? 1 : -1;
      surface_.uses.push_back(use);
      surface_.guides.emplace_back();
      if (surface_.faces[use.face].kind == Kind::nurbs) guide(edge, trims_[k]);
    }
    surface_.edge_slack.push_back(std::max(surface_.slack, given.tolerance));
    tolerance_at_ends_.push_back(
        {model_.vertices[given.vertex[0]].tolerance, model_.vertices[given.vertex[1]].tolerance});
    surface_.edges.push_back(edge);
    order_uses(number, trims);
  }

  void add_spline(const Spline<3>& spline, Edge& edge) {
    edge.axis = edge.radial = edge.origin = Vector3::Zero();
    edge.first_chunk = static_cast<int>(surface_.chunks.size());
    for (const BezierCurve<3>& curve : beziers(spline)) add_chunks(curve, surface_.chunks);
    edge.chunk_count = static_cast<int>(surface_.chunks.size()) - edge.first_chunk;
    for (int c = edge.first_chunk; c + 1 < edge.first_chunk + edge.chunk_count; ++c)
      surface_.chunks[c].way_on = surface_.chunks[c + 1].curve.derivatives(0.0).first;
  }

  // Parameters of points of the edge on the patch: the nearest of its border, one after the other.
  void guide(const Edge& edge, const TrimOf& trim) {
    constexpr int kSamples = 128;
    const int patch = surface_.faces[trim.face].patch;
    const std::vector<BezierCurve<2>> curves = beziers(trim.trim->curve);
    const auto border = [&](double t) {  // 0 to 1 in the sense of the edge
      const double place = (trim.forward ? t : 1.0 - t) * static_cast<double>(curves.size());
      const auto k = std::min(static_cast<size_t>(place), curves.size() - 1);
      const Eigen::Vector2d at = curves[k].at(place - static_cast<double>(k));
      return Parameter<2>{at[0], at[1]};
    };
    std::vector<Vector3> samples;
    for (int k = 0; k <= kSamples; ++k)
      samples.push_back(surface_.patches->point(patch, border(static_cast<double>(k) / kSamples)));
    auto& guides = surface_.guides.back();
    guides.front() = border(0.0), guides.back() = border(1.0);
    int last = 0;
    for (int g = 1; g + 1 < Surface::kGuides; ++g) {
      const Vector3 point = at_part(surface_, edge, static_cast<double>(g) / (Surface::kGuides - 1)).point;
      const auto distance = [&](double t) {
        return (surface_.patches->point(patch, border(t)) - point).norm();
      };
      const auto nearest =
          std::min_element(samples.begin() + last, samples.end(), [&](const auto& a, const auto& b) {
            return (a - point).squaredNorm() < (b - point).squaredNorm();
          });
      last = static_cast<int>(nearest - samples.begin());
      guides[g] = border(
          lowest(distance, std::max(0.0, (last - 1.0) / kSamples), std::min(1.0, (last + 1.0) / kSamples)));
    }
  }

  // Where a function with one minimum has it.
  template <class Function>
  static double lowest(Function f, double low, double high) {
    constexpr int kThirds = 60;
    for (int k = 0; k < kThirds; ++k) {
      const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
      (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
    }
    return 0.5 * (low + high);
  }

  Across axes(const Edge& edge, const EdgePoint& at) const {
    return edge.spline() ? across(at.tangent) : across(edge, at.point);
  }

  // Counterclockwise, as they are half way; whether they are so everywhere.
  void order_uses(int number, const std::vector<int>& trims) {
    Edge& edge = surface_.edges[number];
    const EdgePoint middle = at_part(surface_, edge, 0.5);
    if (edge.line()) edge.radial = side_at(surface_, edge.first_use, middle).conormal;
    if (edge.line()) edge.radial = (edge.radial - edge.radial.dot(edge.axis) * edge.axis).normalized();
    edge.varies = edge.spline();
    const Uses sorted = local_uses(surface_, edge, middle, axes(edge, middle));
    const std::vector<EdgeUse> uses(sorted.begin(), sorted.end());
    const std::vector<int> numbers(sorted.numbers, sorted.numbers + sorted.count);
    for (int k = 0; k < kLooksAlong && !edge.varies; ++k) {
      const EdgePoint at = at_part(surface_, edge, (k + 0.5) / kLooksAlong);
      const Uses here = local_uses(surface_, edge, at, axes(edge, at));
      for (int i = 0; i < here.count; ++i) {
        const double* m = here.with_number(numbers[i]).conormal;
        edge.varies =
            edge.varies || std::hypot(m[0] - uses[i].conormal[0], m[1] - uses[i].conormal[1]) > kConstant;
      }
    }
    const std::vector<std::array<Parameter<2>, Surface::kGuides>> guides(
        surface_.guides.begin() + edge.first_use, surface_.guides.end());
    for (int i = 0; i < edge.use_count; ++i) {
      surface_.uses[edge.first_use + i] = uses[i];
      surface_.guides[edge.first_use + i] = guides[numbers[i] - edge.first_use];
    }
    for (const int k : trims)
      trims_[k].use =
          edge.first_use +
          static_cast<int>(std::find(numbers.begin(), numbers.end(), trims_[k].use) - numbers.begin());
  }

  // Faces that an edge joins on part of its way are of one sheet.
  void join_sheets_along_edges() {
    DisjointSets sets(surface_.sheet_count);
    for (const Edge& edge : surface_.edges) {
      if (!edge.varies) continue;
      for (int k = 0; k < kLooksAlong; ++k) {
        const EdgePoint at = at_part(surface_, edge, (k + 0.5) / kLooksAlong);
        const Uses uses = local_uses(surface_, edge, at, axes(edge, at));
        for (const EdgeUse& use : uses)
          if (joins(use.wedge))
            sets.join(surface_.sheet(use.face, use.side),
                      surface_.sheet(uses.next(use).face, -uses.next(use).side));
      }
    }
    std::vector<int> number;
    surface_.sheet_count = sets.number(number);
    for (int& sheet : surface_.sheets) sheet = number[sheet];
  }

  void add_corners() {
    std::vector<LoopCorner> corners;
    first_of_loop_.push_back(static_cast<int>(trims_.size()));
    for (size_t l = 0; l + 1 < first_of_loop_.size(); ++l) {
      std::vector<const TrimOf*> loop;  // without poles
      for (int k = first_of_loop_[l]; k < first_of_loop_[l + 1]; ++k)
        if (trims_[k].edge >= 0) loop.push_back(&trims_[k]);
      for (size_t k = 0; k < loop.size(); ++k)
        corners.push_back(corner(*loop[(k + loop.size() - 1) % loop.size()], *loop[k]));
    }
    make_corners(surface_, corners);
    surface_.vertex_slack.assign(surface_.vertices.size(), surface_.slack);
    for (size_t e = 0; e < surface_.edges.size(); ++e)
      for (int k = 0; k < 2; ++k) {
        double& slack = surface_.vertex_slack[surface_.edges[e].vertex[k]];
        slack = std::max({slack, surface_.edge_slack[e], tolerance_at_ends_[e][k]});
      }
  }

  LoopCorner corner(const TrimOf& arriving, const TrimOf& leaving) const {
    LoopCorner at{};
    at.face = leaving.face;
    at.ray[0] = 2 * leaving.use + (leaving.forward ? 0 : 1);
    at.ray[1] = 2 * arriving.use + (arriving.forward ? 1 : 0);
    const Edge& edge = surface_.edges[surface_.uses[leaving.use].edge];
    at.vertex = edge.vertex[leaving.forward ? 0 : 1];
    const EdgePoint start = at_end(surface_, edge, leaving.forward ? 0 : 1);
    const EdgePoint end = at_end(surface_, surface_.edges[surface_.uses[arriving.use].edge], at.ray[1] % 2);
    const Vector3 normal = normal_at(surface_, leaving.use, start);
    const Vector3 way = (leaving.forward ? 1.0 : -1.0) * start.tangent,
                  back = (arriving.forward ? -1.0 : 1.0) * end.tangent;
    at.turned = std::atan2(normal.dot(way.cross(back)), way.dot(back));
    const bool slit = leaving.edge == arriving.edge && &leaving != &arriving;  // all round a seam's end
    if (at.turned < -1e-9 || slit) at.turned += nurbs::kTwoPi;
    return at;
  }

  void add_pieces() {
    for (int f = 0; f < static_cast<int>(surface_.faces.size()); ++f) {
      Face& face = surface_.faces[f];
      face.first_piece = static_cast<int>(surface_.pieces.size());
      if (face.kind != Kind::nurbs) {
        surface_.pieces.push_back({f, {-1, -1, -1}, {-1, -1, -1}, Piece::Kind::trimmed});
      } else {
        for (int e = 0; e < surface_.patches->patch(face.patch).space.element_count(); ++e)
          if (is_in(f, e)) surface_.pieces.push_back({f, {-1, -1, -1}, {e, -1, -1}, Piece::Kind::element});
      }
      face.piece_count = static_cast<int>(surface_.pieces.size()) - face.first_piece;
    }
    for (int e = 0; e < static_cast<int>(surface_.edges.size()); ++e) {
      const Edge& edge = surface_.edges[e];
      const int face = surface_.uses[edge.first_use].face;
      for (int c = edge.spline() ? 0 : -1; c < edge.chunk_count; ++c) {
        surface_.pieces.push_back({face, {-1, -1, -1}, {e, c, -1}, Piece::Kind::edge});
        if (c < 0) break;
      }
    }
    for (int v = 0; v < static_cast<int>(surface_.vertices.size()); ++v) {
      const Vertex& vertex = surface_.vertices[v];
      if (vertex.corner_count == 0) continue;
      surface_.pieces.push_back(
          {surface_.corners[vertex.first_corner].face, {v, -1, -1}, {-1, -1, -1}, Piece::Kind::vertex});
    }
  }

  const CadModel& model_;
  Surface surface_;
  int faces_done_ = 0;
  std::vector<TrimOf> trims_;
  std::vector<int> first_of_loop_;
  std::map<int, int> vertices_;                           // of the model to the wall's
  std::vector<std::array<double, 2>> tolerance_at_ends_;  // of edges
};

}  // namespace

Surface from_cad(const CadModel& model, const std::vector<int>& faces, double edge_angle) {
  return FromCad(model, faces, edge_angle).surface();
}

}  // namespace brep

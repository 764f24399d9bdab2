// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/cad_joints.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "brep/disjoint_sets.h"
#include "brep/trim_domain.h"
#include "geometry_io/box_pairs.h"
#include "geometry_io/cad_curves.h"
#include "geometry_io/cad_cuts.h"
#include "geometry_io/cad_inlay.h"

namespace geometry_io {
namespace {

using brep::CadModel;
using brep::Vector3;

constexpr int kLooks = 32;  // along an edge

// Another edge that comes near, at its parameter s.
struct Near {
  int edge;
  double s;
};
// A place on an edge where others are, or its end.
struct Place {
  double t;
  std::vector<Near> near;
};
// A part of an edge between two places that lies on a face.
struct Joint {
  int edge, place;  // the first one
  int face;
};

class Joiner {
 public:
  Joiner(CadModel& model, const std::vector<int>& solids, double tolerance)
      : model_(model), edges_(model, solids), tolerance_(tolerance), domains_(model.faces.size()) {}

  Sewn join() {
    find_places();
    for (int i = 0; i < edges_.count(); ++i)
      if (edges_.is_free(i)) find_joints(i);
    if (!joints_.empty()) cut_and_lay_in();
    return result_;
  }

 private:
  static double at_part(const EdgeCurve& curve, double part) {
    return curve.begin() + part * (curve.end() - curve.begin());
  }

  void find_places() {
    std::vector<search::Box> boxes;
    for (int i = 0; i < edges_.count(); ++i) {
      const EdgeCurve& curve = edges_.curve(i);
      places_.push_back({{curve.begin(), {}}, {curve.end(), {}}});
      std::vector<Vector3> points;
      for (int k = 0; k <= kLooks; ++k)
        points.push_back(curve.point(at_part(curve, static_cast<double>(k) / kLooks)));
      boxes.push_back(box_along(points, tolerance_));
    }
    for_box_pairs(boxes, [&](int i, int j) {
      if (edges_.is_free(i)) find_near(i, j);
      if (edges_.is_free(j)) find_near(j, i);
    });
    for (int i = 0; i < edges_.count(); ++i) gather(i);
  }

  // Where edge i comes nearest to edge j, if within the tolerance; not where it runs along it.
  void find_near(int i, int j) {
    const EdgeCurve &curve = edges_.curve(i), &other = edges_.curve(j);
    const auto place = [&](double t) { return other.nearest(curve.point(t), other.begin(), other.end()); };
    std::vector<double> away;
    for (int k = 0; k <= kLooks; ++k)
      away.push_back(place(at_part(curve, static_cast<double>(k) / kLooks)).distance);
    for (int k = 0; k <= kLooks; ++k) {
      const int before = std::max(k - 1, 0), behind = std::min(k + 1, kLooks);
      if (away[k] > away[before] || away[k] > away[behind]) continue;
      if (away[before] <= tolerance_ && away[behind] <= tolerance_) return;
      const double t = lowest([&](double x) { return place(x).distance; },
                              at_part(curve, static_cast<double>(before) / kLooks),
                              at_part(curve, static_cast<double>(behind) / kLooks));
      const CurvePlace found = place(t);
      if (found.distance <= tolerance_) places_[i].push_back({t, {{j, found.t}}});
    }
  }
  template <class Function>
  static double lowest(const Function& f, double low, double high) {
    constexpr int kThirds = 60;
    for (int k = 0; k < kThirds; ++k) {
      const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
      (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
    }
    return 0.5 * (low + high);
  }

  // Along an edge; those nearer to each other than the tolerance are one, an end if one of them is.
  void gather(int i) {
    std::vector<Place>& places = places_[i];
    std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.t < b.t; });
    const EdgeCurve& curve = edges_.curve(i);
    const double first = curve.begin(), last = curve.end();
    std::vector<Place> gathered;
    for (Place& place : places) {
      const auto is_same = [&](const Place& known) {  // not if they are the two ends of a closed one
        return place.t - known.t < 0.5 * (last - first) &&
               (curve.point(place.t) - curve.point(known.t)).norm() <= tolerance_;
      };
      const bool same = !gathered.empty() && is_same(gathered.back());
      if (!same) {
        gathered.push_back(std::move(place));
        continue;
      }
      Place& known = gathered.back();
      known.near.insert(known.near.end(), place.near.begin(), place.near.end());
      if (place.t == last) known.t = last;
    }
    places = std::move(gathered);
  }

  void find_joints(int i) {
    constexpr double kShort = 8.0;  // over the tolerance
    const EdgeCurve& curve = edges_.curve(i);
    for (size_t k = 0; k + 1 < places_[i].size(); ++k) {
      const double from = places_[i][k].t, to = places_[i][k + 1].t;
      const Vector3 middle = curve.point(0.5 * (from + to));
      if ((curve.point(from) - middle).norm() + (curve.point(to) - middle).norm() < kShort * tolerance_)
        continue;
      for (size_t f = 0; f < model_.faces.size(); ++f)
        if (lies_on(i, from, to, static_cast<int>(f))) {
          joints_.push_back({i, static_cast<int>(k), static_cast<int>(f)});
          break;
        }
    }
  }

  bool lies_on(int i, double from, double to, int f) {
    constexpr int kInner = 15;
    constexpr double kFlat = 0.02;  // [rad]
    const brep::CadFace& face = model_.faces[f];
    const TrimPlace& own = edges_.uses(i).front();
    if (!edges_.has(face) || face.shape.kind == brep::Kind::nurbs || own.face == f) return false;
    for (int k = 0; k < kInner; ++k) {
      const double t =
          from + (to - from) * ((k + kInner / 2) % kInner + 1) / (kInner + 1);  // the middle first
      const Vector3 p = edges_.curve(i).point(t), tangent = edges_.curve(i).tangent(t);
      const brep::Projection foot = face.shape.project(p);
      if (std::abs(foot.height) > tolerance_) return false;
      if (!domains_[f]) domains_[f].emplace(face.loops);
      if (!domains_[f]->inside(foot.xi)) return false;
      if (k > 2) continue;
      const BorderCurve border(model_, model_.faces[own.face], trim_at(model_, own));
      if (std::abs(border.conormal(border.beside(p, tangent), tangent).dot(foot.normal)) < std::sin(kFlat))
        return false;
    }
    return true;
  }

  // The vertex of an edge there, which is cut if it has none.
  int vertex_at(int i, double t) {
    const EdgeCurve& curve = edges_.curve(i);
    const Vector3 p = curve.point(t);
    const auto is_there = [&](double s) { return (curve.point(s) - p).norm() <= tolerance_; };
    const int* ends = model_.edges[edges_.in_model(i)].vertex;
    if (is_there(curve.begin())) return ends[0];
    if (is_there(curve.end())) return ends[1];
    std::vector<Cut>& cuts = cuts_[edges_.in_model(i)];
    for (const Cut& cut : cuts)
      if (is_there(cut.t)) return cut.vertex;
    cuts.push_back({t, static_cast<int>(model_.vertices.size())});
    model_.vertices.push_back({p, model_.edges[edges_.in_model(i)].tolerance});
    return cuts.back().vertex;
  }

  bool bounds(int i, int face) const {
    const auto of_face = [&](const TrimPlace& use) { return use.face == face; };
    const auto laid_in = [&](const Joint& joint) { return joint.edge == i && joint.face == face; };
    return std::any_of(edges_.uses(i).begin(), edges_.uses(i).end(), of_face) ||
           std::any_of(joints_.begin(), joints_.end(), laid_in);
  }

  void cut_and_lay_in() {
    cuts_.resize(model_.edges.size());
    std::vector<std::pair<int, int>> same;
    for (const Joint& joint : joints_)
      for (int end = 0; end < 2; ++end) {
        const Place& place = places_[joint.edge][joint.place + end];
        const int vertex = vertex_at(joint.edge, place.t);
        for (const Near& near : place.near)
          if (bounds(near.edge, joint.face)) same.emplace_back(vertex, vertex_at(near.edge, near.s));
      }
    for (std::vector<Cut>& cuts : cuts_)
      std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.t < b.t; });
    const std::vector<std::vector<int>> parts = cut_edges(model_, cuts_);
    brep::DisjointSets vertices(static_cast<int>(model_.vertices.size()));
    for (const auto& [a, b] : same) vertices.join(a, b);
    merge_vertices(model_, vertices);
    for (const Joint& joint : joints_) lay_in(joint, parts[edges_.in_model(joint.edge)]);
  }

  void lay_in(const Joint& joint, const std::vector<int>& parts) {
    const std::vector<Place>& places = places_[joint.edge];
    const double middle = 0.5 * (places[joint.place].t + places[joint.place + 1].t);
    const std::vector<Cut>& cuts = cuts_[edges_.in_model(joint.edge)];
    const auto before = [&](const Cut& cut) { return cut.t < middle; };
    const int edge = parts[std::count_if(cuts.begin(), cuts.end(), before)];
    brep::CadFace& face = model_.faces[joint.face];
    std::optional<brep::Spline<2>> curve = curve_on(face.shape, model_.edges[edge], tolerance_);
    if (!curve) return;
    geometry_io::lay_in(model_, joint.face, edge, std::move(*curve));
    ++result_.edges;
    for (const brep::Loop& loop : face.loops)
      for (const brep::Trim& trim : loop)
        if (trim.edge == edge) result_.widest = std::max(result_.widest, note_gap(model_, face, trim));
  }

  CadModel& model_;
  const SheetEdges edges_;
  const double tolerance_;
  std::vector<std::vector<Place>> places_;
  std::vector<std::optional<brep::TrimDomain>> domains_;  // of faces
  std::vector<Joint> joints_;
  std::vector<std::vector<Cut>> cuts_;  // of edges of the model
  Sewn result_;
};

}  // namespace

Sewn join_to_faces(CadModel& model, const std::vector<int>& solids, double tolerance) {
  return Joiner(model, solids, tolerance).join();
}

}  // namespace geometry_io

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
      : model_(model), solids_(solids), tolerance_(tolerance), uses_(uses_of_edges(model)) {}

  Sewn join() {
    take_edges();
    find_places();
    for (size_t i = 0; i < edges_.size(); ++i)
      if (is_free(static_cast<int>(i))) find_joints(static_cast<int>(i));
    if (!joints_.empty()) cut_and_lay_in();
    return result_;
  }

 private:
  bool is_free(int i) const { return uses_[edges_[i]].size() == 1; }

  bool is_of_sheets(const brep::CadFace& face) const {
    return std::find(solids_.begin(), solids_.end(), face.solid) != solids_.end();
  }

  void take_edges() {
    for (size_t e = 0; e < uses_.size(); ++e) {
      if (uses_[e].empty() || !is_of_sheets(model_.faces[uses_[e].front().face])) continue;
      edges_.push_back(static_cast<int>(e));
      curves_.emplace_back(model_.edges[e]);
      const EdgeCurve& curve = curves_.back();
      places_.push_back({{curve.begin(), {}}, {curve.end(), {}}});
      search::Box box{curve.point(curve.begin()), curve.point(curve.begin())};
      for (int k = 1; k <= kLooks; ++k) {
        const Vector3 p = curve.point(at_part(curve, static_cast<double>(k) / kLooks));
        box.low = box.low.cwiseMin(p), box.high = box.high.cwiseMax(p);
      }
      box.inflate(tolerance_ + step_of(curve));
      boxes_.push_back(box);
    }
    domains_.resize(model_.faces.size());
  }
  static double at_part(const EdgeCurve& curve, double part) {
    return curve.begin() + part * (curve.end() - curve.begin());
  }
  static double step_of(const EdgeCurve& curve) {
    double step = 0.0;
    for (int k = 0; k < kLooks; ++k)
      step = std::max(step, (curve.point(at_part(curve, (k + 1.0) / kLooks)) -
                             curve.point(at_part(curve, static_cast<double>(k) / kLooks)))
                                .norm());
    return step;
  }

  void find_places() {
    for_box_pairs(boxes_, [&](int i, int j) {
      if (is_free(i)) find_near(i, j);
      if (is_free(j)) find_near(j, i);
    });
    for (size_t i = 0; i < places_.size(); ++i) gather(static_cast<int>(i));
  }

  // Where edge i comes nearest to edge j, if within the tolerance; not where it runs along it.
  void find_near(int i, int j) {
    const EdgeCurve &curve = curves_[i], &other = curves_[j];
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
    const double first = curves_[i].begin(), last = curves_[i].end();
    std::vector<Place> gathered;
    for (Place& place : places) {
      const auto is_same = [&](const Place& known) {  // not if they are the two ends of a closed one
        return place.t - known.t < 0.5 * (last - first) &&
               (curves_[i].point(place.t) - curves_[i].point(known.t)).norm() <= tolerance_;
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
    for (size_t k = 0; k + 1 < places_[i].size(); ++k) {
      const double from = places_[i][k].t, to = places_[i][k + 1].t;
      const Vector3 middle = curves_[i].point(0.5 * (from + to));
      if ((curves_[i].point(from) - middle).norm() + (curves_[i].point(to) - middle).norm() <
          kShort * tolerance_)
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
    const TrimPlace& own = uses_[edges_[i]].front();
    if (!is_of_sheets(face) || face.shape.kind == brep::Kind::nurbs || own.face == f) return false;
    for (int k = 0; k < kInner; ++k) {
      const double t =
          from + (to - from) * ((k + kInner / 2) % kInner + 1) / (kInner + 1);  // the middle first
      const Vector3 p = curves_[i].point(t), tangent = curves_[i].tangent(t);
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
    const Vector3 p = curves_[i].point(t);
    const int* ends = model_.edges[edges_[i]].vertex;
    for (int end = 0; end < 2; ++end)
      if ((curves_[i].point(end == 0 ? curves_[i].begin() : curves_[i].end()) - p).norm() <= tolerance_)
        return ends[end];
    std::vector<Cut>& cuts = cuts_[edges_[i]];
    for (const Cut& cut : cuts)
      if ((curves_[i].point(cut.t) - p).norm() <= tolerance_) return cut.vertex;
    cuts.push_back({t, static_cast<int>(model_.vertices.size())});
    model_.vertices.push_back({p, model_.edges[edges_[i]].tolerance});
    return cuts.back().vertex;
  }

  bool bounds(int i, int face) const {
    const auto of_face = [&](const TrimPlace& use) { return use.face == face; };
    const auto laid_in = [&](const Joint& joint) { return joint.edge == i && joint.face == face; };
    return std::any_of(uses_[edges_[i]].begin(), uses_[edges_[i]].end(), of_face) ||
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
    for (const Joint& joint : joints_) lay_in(joint, parts[edges_[joint.edge]]);
  }

  void lay_in(const Joint& joint, const std::vector<int>& parts) {
    const std::vector<Place>& places = places_[joint.edge];
    const double middle = 0.5 * (places[joint.place].t + places[joint.place + 1].t);
    const std::vector<Cut>& cuts = cuts_[edges_[joint.edge]];
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
  const std::vector<int>& solids_;
  const double tolerance_;
  const std::vector<std::vector<TrimPlace>> uses_;  // before anything is cut
  std::vector<int> edges_;                          // of the sheet; what follows has numbers of these
  std::vector<EdgeCurve> curves_;
  std::vector<search::Box> boxes_;
  std::vector<std::vector<Place>> places_;
  std::vector<std::optional<brep::TrimDomain>> domains_;  // of faces
  std::vector<Joint> joints_;
  std::vector<std::vector<Cut>> cuts_;  // of edges of the model
  Sewn result_;
};

}  // namespace

Sewn join_to_faces(CadModel& model, const std::vector<int>& solids, double tolerance) {
  const Sewn joined = Joiner(model, solids, tolerance).join();
  drop_unused(model);
  return joined;
}

}  // namespace geometry_io

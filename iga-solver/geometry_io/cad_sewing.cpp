// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/cad_sewing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "brep/disjoint_sets.h"
#include "geometry_io/box_pairs.h"
#include "geometry_io/cad_curves.h"
#include "geometry_io/cad_cuts.h"
#include "geometry_io/cad_measures.h"

namespace geometry_io {
namespace {

using brep::CadModel;
using brep::Vector3;

constexpr int kSamples = 17;  // of an edge, ends included

// A part of an edge that may be joined as a whole.
struct Span {
  int edge;
  double from, to;
  int vertex[2];
  std::array<Vector3, kSamples> points;
  bool cut[2];  // whether it ends inside of its edge
  double at(double part) const { return from + part * (to - from); }
  double length() const {
    double sum = 0.0;
    for (int k = 1; k < kSamples; ++k) sum += (points[k] - points[k - 1]).norm();
    return sum;
  }
};

struct Match {
  int span[2];
  bool turned;  // they run against each other
  double apart;
};

class Sewer {
 public:
  Sewer(CadModel& model, const std::vector<int>& solids, double tolerance)
      : model_(model), edges_(model, solids), tolerance_(tolerance) {}

  Sewn sew() {
    if (!edges_.is_any_free()) return result_;
    find_places();
    make_spans();
    find_matches();
    choose();
    join();
    return result_;
  }

 private:
  std::array<Vector3, kSamples> samples(int i, double from, double to) const {
    std::array<Vector3, kSamples> points;
    for (int k = 0; k < kSamples; ++k)
      points[k] = edges_.curve(i).point(from + (to - from) * k / (kSamples - 1));
    return points;
  }

  // Where another edge begins or ends beside this one, and one of them is free.
  void find_places() {
    places_.resize(edges_.count());
    std::vector<search::Box> boxes;
    for (int i = 0; i < edges_.count(); ++i)
      boxes.push_back(box_along(samples(i, edges_.curve(i).begin(), edges_.curve(i).end()), tolerance_));
    for_box_pairs(boxes, [&](int i, int j) {
      if (!edges_.is_free(i) && !edges_.is_free(j)) return;
      for (const auto& [on, of] : {std::pair{i, j}, std::pair{j, i}})
        for (const double end : {edges_.curve(of).begin(), edges_.curve(of).end()})
          add_place(on, edges_.curve(of).point(end));
    });
  }

  void add_place(int i, const Vector3& point) {
    const EdgeCurve& curve = edges_.curve(i);
    for (const double end : {curve.begin(), curve.end()})
      if ((curve.point(end) - point).norm() <= tolerance_) return;
    const CurvePlace place = curve.nearest(point, curve.begin(), curve.end());
    if (place.distance <= tolerance_) places_[i].push_back(place.t);
  }

  // Places nearer to each other, or to an end, than the tolerance are one.
  void make_spans() {
    for (int i = 0; i < edges_.count(); ++i) {
      const EdgeCurve& curve = edges_.curve(i);
      std::sort(places_[i].begin(), places_[i].end());
      std::vector<double> ends{curve.begin()};
      for (const double t : places_[i])
        if ((curve.point(t) - curve.point(ends.back())).norm() > tolerance_ &&
            (curve.point(t) - curve.point(curve.end())).norm() > tolerance_)
          ends.push_back(t);
      ends.push_back(curve.end());
      first_span_.push_back(static_cast<int>(spans_.size()));
      const int* vertex = model_.edges[edges_.in_model(i)].vertex;
      for (size_t k = 0; k + 1 < ends.size(); ++k) {
        const bool last = k + 2 == ends.size();
        Span span{i, ends[k], ends[k + 1], {vertex[0], vertex[1]}, {}, {k > 0, !last}};
        span.points = samples(span.edge, span.from, span.to);
        if (k > 0) span.vertex[0] = spans_.back().vertex[1];
        if (!last) {
          span.vertex[1] = static_cast<int>(model_.vertices.size());
          model_.vertices.push_back({curve.point(span.to), model_.edges[edges_.in_model(i)].tolerance});
        }
        spans_.push_back(span);
      }
    }
    first_span_.push_back(static_cast<int>(spans_.size()));
  }

  void find_matches() {
    std::vector<search::Box> boxes;
    for (const Span& span : spans_) boxes.push_back(box_along(span.points, tolerance_));
    for_box_pairs(boxes, [&](int i, int j) {
      if (const auto found = match(std::min(i, j), std::max(i, j)))
        matches_.emplace(std::pair{found->span[0], found->span[1]}, *found);
    });
  }

  std::optional<Match> match(int i, int j) const {
    const Span &a = spans_[i], &b = spans_[j];
    if (a.edge == b.edge || (!edges_.is_free(a.edge) && !edges_.is_free(b.edge))) return {};
    constexpr int kMiddle = kSamples / 2;
    const CurvePlace beside = edges_.curve(b.edge).nearest(a.points[kMiddle], b.from, b.to);
    if (beside.distance > tolerance_) return {};
    const bool turned =
        edges_.curve(a.edge).tangent(a.at(0.5)).dot(edges_.curve(b.edge).tangent(beside.t)) < 0.0;
    for (int end = 0; end < 2; ++end)  // of which each may stand for others that are as near
      if ((a.points[end * (kSamples - 1)] - b.points[(end != (turned ? 1 : 0)) * (kSamples - 1)]).norm() >
          2.0 * tolerance_)
        return {};
    double apart = 0.0;
    for (const auto& [one, other] : {std::pair{&a, &b}, std::pair{&b, &a}})
      for (int k = 2; k < kSamples - 1 && apart <= tolerance_; k += 2)
        apart = std::max(apart,
                         edges_.curve(other->edge).nearest(one->points[k], other->from, other->to).distance);
    constexpr double kWide = 0.25;  // over their length
    if (apart > std::min(tolerance_, kWide * std::min(a.length(), b.length())) || fold(a, b)) return {};
    return Match{{i, j}, turned, apart};
  }

  // Whether faces on both lie back on each other, or are one that is narrower than the tolerance.
  bool fold(const Span& a, const Span& b) const {
    for (const TrimPlace& with : edges_.uses(a.edge))
      for (const TrimPlace& beside : edges_.uses(b.edge))
        for (const double part : {0.25, 0.5, 0.75})
          if (fold(a, with, b, beside, part)) return true;
    return false;
  }
  bool fold(const Span& a, const TrimPlace& with, const Span& b, const TrimPlace& beside, double part) const {
    constexpr double kFolded = 0.02;  // [rad]
    const EdgeCurve &one = edges_.curve(a.edge), &other = edges_.curve(b.edge);
    const double s = a.at(part), t = other.nearest(one.point(s), b.from, b.to).t;
    const BorderCurve border[2] = {border_of(with), border_of(beside)};
    const double at[2] = {border[0].beside(one.point(s), one.tangent(s)),
                          border[1].beside(other.point(t), other.tangent(t))};
    const Vector3 m = border[0].conormal(at[0], one.tangent(s)),
                  n = border[1].conormal(at[1], other.tangent(t));
    if (m.dot(n) > std::cos(kFolded)) return true;
    if (with.face != beside.face) return false;
    const nurbs::Parameter<2> p = border[0].parameters(at[0]), q = border[1].parameters(at[1]);
    const Vector3 between =
        point_of(model_, model_.faces[with.face], {0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])});
    return (between - one.point(s)).norm() <= 2.0 * tolerance_;
  }
  BorderCurve border_of(const TrimPlace& use) const {
    return {model_, model_.faces[use.face], trim_at(model_, use)};
  }

  // What is as near within a thousandth of the tolerance goes by its number.
  void choose() {
    std::vector<Match> by_distance;
    for (const auto& [pair, found] : matches_) by_distance.push_back(found);
    std::stable_sort(by_distance.begin(), by_distance.end(), [&](const Match& a, const Match& b) {
      const double step = 1e-3 * tolerance_;
      return std::floor(a.apart / step) < std::floor(b.apart / step);
    });
    for (size_t k = 0; k < spans_.size(); ++k) {
      groups_.push_back({static_cast<int>(k)});
      group_of_.push_back(static_cast<int>(k));
      if (spans_[k].length() < 8.0 * tolerance_) short_.push_back(static_cast<int>(k));
    }
    vertices_.reset(static_cast<int>(model_.vertices.size()));
    for (const Match& match : by_distance) unite(match);
  }

  void unite(const Match& match) {
    const int i = group_of_[match.span[0]], j = group_of_[match.span[1]];
    if (i == j) return;
    for (const int a : groups_[i])
      for (const int b : groups_[j])
        if (matches_.count(std::minmax(a, b)) == 0) return;
    int ends[2][2];
    for (int end = 0; end < 2; ++end) {
      ends[end][0] = spans_[match.span[0]].vertex[end];
      ends[end][1] = spans_[match.span[1]].vertex[match.turned ? 1 - end : end];
    }
    if (some_vanish(ends)) return;
    for (const auto& pair : ends) vertices_.join(pair[0], pair[1]);
    for (const int b : groups_[j]) group_of_[b] = i;
    groups_[i].insert(groups_[i].end(), groups_[j].begin(), groups_[j].end());
    groups_[j].clear();
  }

  // Whether an edge would begin and end in one vertex if these were joined.
  bool some_vanish(const int (&ends)[2][2]) {
    brep::DisjointSets joined = short_.empty() ? brep::DisjointSets(0) : vertices_;
    for (const int k : short_) {
      const int* vertex = spans_[k].vertex;
      if (vertices_.find(vertex[0]) == vertices_.find(vertex[1])) continue;  // it is closed
      for (const auto& pair : ends) joined.join(pair[0], pair[1]);
      if (joined.find(vertex[0]) == joined.find(vertex[1])) return true;
    }
    return false;
  }

  void join() {
    for (const std::vector<int>& group : groups_) result_.edges += group.size() > 1 ? 1 : 0;
    if (result_.edges == 0) return;
    const std::vector<int> edge_of = cut();
    std::vector<std::pair<int, bool>> becomes;  // of an edge: another, and whether that runs against it
    for (size_t e = 0; e < model_.edges.size(); ++e) becomes.emplace_back(static_cast<int>(e), false);
    for (const std::vector<int>& group : groups_)
      for (const int k : group)
        if (k != group.front())
          becomes[edge_of[k]] = {edge_of[group.front()], matches_.at(std::minmax(k, group.front())).turned};
    merge_vertices(model_, vertices_);
    for (brep::CadFace& face : model_.faces)
      for (brep::Loop& loop : face.loops)
        for (brep::Trim& trim : loop)
          if (trim.edge >= 0 && becomes[trim.edge].first != trim.edge) {
            const auto [edge, turned] = becomes[trim.edge];
            trim.edge = edge;
            trim.forward = trim.forward != turned;
            result_.widest = std::max(result_.widest, note_gap(model_, face, trim));
          }
  }

  // Edges where spans that are joined end; the edge of every such span.
  std::vector<int> cut() {
    const auto joined = [&](int k) { return groups_[group_of_[k]].size() > 1; };
    std::vector<std::vector<Cut>> cuts(model_.edges.size());
    for (int i = 0; i < edges_.count(); ++i)
      for (int k = first_span_[i]; k + 1 < first_span_[i + 1]; ++k)
        if (joined(k) || joined(k + 1))
          cuts[edges_.in_model(i)].push_back({spans_[k].to, spans_[k].vertex[1]});
    const std::vector<std::vector<int>> parts = cut_edges(model_, cuts);
    std::vector<int> edge_of(spans_.size(), -1);
    for (int i = 0; i < edges_.count(); ++i) {
      size_t part = 0;
      for (int k = first_span_[i]; k < first_span_[i + 1]; ++k) {
        if (k > first_span_[i] && (joined(k - 1) || joined(k))) ++part;
        edge_of[k] = parts[edges_.in_model(i)][part];
      }
    }
    return edge_of;
  }

  CadModel& model_;
  const SheetEdges edges_;
  const double tolerance_;
  std::vector<std::vector<double>> places_;
  std::vector<int> first_span_;
  std::vector<Span> spans_;
  std::map<std::pair<int, int>, Match> matches_;
  std::vector<std::vector<int>> groups_;
  std::vector<int> group_of_, short_;
  brep::DisjointSets vertices_{0};
  Sewn result_;
};

}  // namespace

Sewn sew(CadModel& model, const std::vector<int>& solids, double tolerance) {
  return Sewer(model, solids, tolerance).sew();
}

}  // namespace geometry_io

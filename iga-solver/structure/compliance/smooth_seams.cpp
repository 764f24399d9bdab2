// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/smooth_seams.h"

#include <algorithm>
#include <utility>

#include "structure/conditions/skin_surface.h"

namespace structure {

namespace {

/// Where a net of this knot vector may have a kink: at its ends, and where a knot stands as often as the
/// degree is.
std::vector<int> places_of_creases(const nurbs::KnotVector& knots) {
  std::vector<int> places;
  for (const double crease : knots.creases())
    places.push_back(crease == knots.back() ? knots.control_point_count() - 1
                                            : knots.find_span(crease) - knots.degree());
  return places;
}

/// Nodes beside one on such a line, across it, with the degree there and the next one beyond; -1: there is
/// none.
struct Beyond {
  int degree;
  Id next;
};
using Across = std::map<Id, Beyond>;

std::map<Id, Across> nodes_across(const ReferenceBody& body, const std::vector<SkinPiece>& skin) {
  std::map<Id, Across> found;
  for (const SkinPiece& piece : skin) {
    const SkinSurface surface = skin_surface(body.patches[piece.patch], piece, body.nodes);
    const nurbs::Space<2>& space = surface.face.space;
    const std::vector<int>& nodes = surface.face.volume_control_point;
    const int counts[] = {space.control_point_count(0), space.control_point_count(1)},
              strides[] = {1, counts[0]};
    for (int d = 0; d < 2; ++d)
      for (const int crease : places_of_creases(space.knots(d)))
        for (int along = 0; along < counts[1 - d]; ++along)
          for (const int side : {-1, 1}) {
            const auto node = [&](int steps) {
              const int at = crease + side * steps;
              return at < 0 || at >= counts[d] ? Id(-1) : Id(nodes[along * strides[1 - d] + at * strides[d]]);
            };
            const Id beside = node(1);
            if (beside < 0 || beside == node(0)) continue;  // they are one at a pole
            found[node(0)].emplace(beside, Beyond{space.degree(d), node(2)});
          }
  }
  return found;
}

/// Two nodes that one is between, on a line.
struct Pair {
  Id nodes[2], next[2];
  double shares[2];
  int degree;
  double bend;  // a - b over the same of those next, of cubic patches, if it is on a parallel; else 0
};

Vector3 place_of(const ReferenceBody& body, Id node) {
  const auto [patch, control_point] = body.nodes.place(node);
  return body.patches[patch].control_points.col(control_point);
}

std::vector<Pair> pairs_of(const ReferenceBody& body, Id node, const Across& across) {
  constexpr double kStraight = 1e-6;  // how far from the line, beside the distances
  const Vector3 here = place_of(body, node);
  std::vector<Pair> pairs;
  for (auto a = across.begin(); a != across.end(); ++a)
    for (auto b = std::next(a); b != across.end(); ++b) {
      const Vector3 ways[] = {place_of(body, a->first) - here, place_of(body, b->first) - here};
      const double distances[] = {ways[0].norm(), ways[1].norm()}, both = distances[0] + distances[1];
      const double shares[] = {distances[1] / both, distances[0] / both};
      if (!((shares[0] * ways[0] + shares[1] * ways[1]).norm() <= kStraight * both)) continue;
      Pair pair = {{a->first, b->first},
                   {a->second.next, b->second.next},
                   {shares[0], shares[1]},
                   std::min(a->second.degree, b->second.degree),
                   0.0};
      if (pair.degree > 2 && pair.next[0] >= 0 && pair.next[1] >= 0) {
        const Vector3 way = ways[0] - ways[1],
                      further = place_of(body, pair.next[0]) - place_of(body, pair.next[1]);
        const double bend = way.norm() / further.norm();
        if ((way - bend * further).norm() <= kStraight * both) pair.bend = bend;
      }
      pairs.push_back(pair);
    }
  return pairs;
}

using Row = SmoothSeams::Row;

void add(Row& row, double share, const Row& other) {
  for (const auto& [node, part] : other) row[node] += share * part;
}

Row row_of(const Pair& pair) { return {{pair.nodes[0], pair.shares[0]}, {pair.nodes[1], pair.shares[1]}}; }

const SmoothSeams::Press& press_of(const Pair& pair) { return SmoothSeams::kPress[pair.degree > 2]; }

}  // namespace

SmoothSeams::SmoothSeams(const ReferenceBody& body, const std::vector<SkinPiece>& skin) {
  std::map<Id, std::vector<Pair>> pairs;
  for (const auto& [node, across] : nodes_across(body, skin))
    if (std::vector<Pair> found = pairs_of(body, node, across); !found.empty())
      pairs.emplace(node, std::move(found));
  const auto first_pair = [&](Id node) {
    const auto found = pairs.find(node);
    return found == pairs.end() ? nullptr : &found->second.front();
  };
  for (const auto& [node, own] : pairs) {
    const Pair& pair = own.front();
    Row& between = between_[node];
    const Pair* const beside[] = {first_pair(pair.nodes[0]), first_pair(pair.nodes[1])};
    for (int k = 0; k < 2; ++k)
      add(between, pair.shares[k], beside[k] ? row_of(*beside[k]) : Row{{pair.nodes[k], 1.0}});
    Row kink = {{node, 1.0}};
    for (const Pair& one : own) add(kink, -1.0, row_of(one));
    const Press& press = press_of(pair);
    if (beside[0] || beside[1]) {  // two seams cross: products of both
      if (!beside[0] || !beside[1] || own.size() != 2) continue;
      add(kink, 1.0, between);
      for (const auto& [met, share] : between)
        add(rows_[met], press.kink[0] * press_of(*beside[0]).kink[0], kink);
      continue;
    }
    const Row bend = {
        {pair.nodes[0], 1.0}, {pair.nodes[1], -1.0}, {pair.next[0], -pair.bend}, {pair.next[1], pair.bend}};
    for (int k = 0; k < 2; ++k)
      for (int step = 0; step < 2; ++step) {
        const Id met = step == 0 ? pair.nodes[k] : pair.next[k];
        if (met < 0 || pairs.count(met) > 0) continue;
        add(rows_[met], press.kink[step], kink);
        if (pair.bend > 0.0) add(rows_[met], k == 0 ? press.bend[step] : -press.bend[step], bend);
      }
  }
  for (auto& [node, row] : rows_) row[node] += 1.0;
  std::map<Id, Row> on_seams;
  for (const auto& [node, between] : between_)
    for (const auto& [beside, share] : between) {
      const auto met = rows_.find(beside);
      add(on_seams[node], share, met == rows_.end() ? Row{{beside, 1.0}} : met->second);
    }
  rows_.insert(on_seams.begin(), on_seams.end());
}

std::vector<SmoothSeams::Share> SmoothSeams::shares() const {
  std::vector<Share> shares;
  for (const auto& [from, row] : rows_)
    for (const auto& [to, share] : row) shares.push_back({from, to, share});
  return shares;
}

void SmoothSeams::carry(std::vector<Id>& nodes, std::vector<double>& forces) const {
  if (std::none_of(nodes.begin(), nodes.end(), [&](Id node) { return rows_.count(node) > 0; })) return;
  Row sums;
  for (std::size_t a = 0; a < nodes.size(); ++a)
    if (const auto row = rows_.find(nodes[a]); row != rows_.end())
      for (const auto& [to, share] : row->second) sums[to] += share * forces[a];
    else
      sums[nodes[a]] += forces[a];
  nodes.clear();
  forces.clear();
  for (const auto& [node, force] : sums) {
    nodes.push_back(node);
    forces.push_back(force);
  }
}

SkinPoint SmoothSeams::carried(SkinPoint foot) const {
  carry(foot.nodes, foot.R);
  return foot;
}

}  // namespace structure

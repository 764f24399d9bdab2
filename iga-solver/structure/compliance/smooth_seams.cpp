// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/smooth_seams.h"

#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
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

/// Nodes beside one on such a line, across it, with the piece and the direction there, the next one beyond,
/// and those beside them along the line; -1: there is none.
struct Beyond {
  int piece, direction, degree;
  Id next, along[2];
};
using Across = std::map<Id, Beyond>;

std::map<Id, Across> nodes_across(const ReferenceBody& body, const std::vector<SkinPiece>& skin) {
  std::map<Id, Across> found;
  for (std::size_t p = 0; p < skin.size(); ++p) {
    const SkinPiece& piece = skin[p];
    const SkinSurface surface = skin_surface(body.patches[piece.patch], piece, body.nodes);
    const nurbs::Space<2>& space = surface.face.space;
    const std::vector<int>& nodes = surface.face.volume_control_point;
    const int counts[] = {space.control_point_count(0), space.control_point_count(1)},
              strides[] = {1, counts[0]};
    for (int d = 0; d < 2; ++d)
      for (const int crease : places_of_creases(space.knots(d)))
        for (int along = 0; along < counts[1 - d]; ++along)
          for (const int side : {-1, 1}) {
            const auto node = [&](int steps, int aside = 0) {
              const int at[] = {crease + side * steps, along + aside};
              return at[0] < 0 || at[0] >= counts[d] || at[1] < 0 || at[1] >= counts[1 - d]
                         ? Id(-1)
                         : Id(nodes[at[1] * strides[1 - d] + at[0] * strides[d]]);
            };
            const Id beside = node(1);
            if (beside < 0 || beside == node(0)) continue;  // they are one at a pole
            found[node(0)].emplace(
                beside, Beyond{static_cast<int>(p), d, space.degree(d), node(2), {node(1, -1), node(1, 1)}});
          }
  }
  return found;
}

using Row = SmoothSeams::Row;

void add(Row& row, double share, const Row& other) {
  for (const auto& [node, part] : other) row[node] += share * part;
}

/// The row that differs least from `start`, by shares of nodes beside its own, of those that take any affine
/// map to that of `sum` times a node's: at `here` if sum is 1.  None: it would take too much of them.
/// `scale`: how far apart its nodes are.
std::optional<Row> affine_row(const ReferenceBody& body, const Vector3& here, double scale, double sum,
                              const Row& start, const std::vector<Id>& beside) {
  constexpr double kExact = 1e-6, kMost = 0.5;
  const auto affine = [&](Id node) {
    return Eigen::Vector4d(((body.place(node) - here) / scale).homogeneous());
  };
  Eigen::Vector4d missing = sum * Eigen::Vector4d::UnitW();
  for (const auto& [node, share] : start) missing -= share * affine(node);
  if (missing.norm() <= kExact) return start;
  std::vector<Id> nodes = beside;
  for (const auto& [node, share] : start) nodes.push_back(node);
  Eigen::MatrixXd of_nodes(4, nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) of_nodes.col(k) = affine(nodes[k]);
  const Eigen::VectorXd change = of_nodes.completeOrthogonalDecomposition().solve(missing);
  if ((missing - of_nodes * change).norm() > kExact || change.cwiseAbs().maxCoeff() > kMost) return {};
  Row row = start;
  for (std::size_t k = 0; k < nodes.size(); ++k) row[nodes[k]] += change[k];
  return row;
}

/// Pairs of nodes across from each other, about: not the corner of a piece.
using Sides = std::vector<std::pair<Across::const_iterator, Across::const_iterator>>;
Sides sides_of(const ReferenceBody& body, Id node, const Across& across) {
  constexpr double kOn = -0.4;
  const Vector3 here = body.place(node);
  Sides sides;
  for (auto a = across.begin(); a != across.end(); ++a)
    for (auto b = std::next(a); b != across.end(); ++b) {
      if (a->second.piece == b->second.piece && a->second.direction != b->second.direction) continue;
      const Vector3 ways[] = {body.place(a->first) - here, body.place(b->first) - here};
      if (ways[0].dot(ways[1]) < kOn * ways[0].norm() * ways[1].norm()) sides.emplace_back(a, b);
    }
  return sides;
}

/// Whether the net is about plane at a node: edges, of some 10 degrees and more, are not.
bool is_flat(const ReferenceBody& body, Id node, const Across& across) {
  constexpr double kFlat = 0.1;
  std::vector<Vector3> ways(3, Vector3::Zero());
  const auto way_to = [&](Id other) { ways.push_back((body.place(other) - body.place(node)).normalized()); };
  for (const auto& [beside, beyond] : across) {
    way_to(beside);
    for (const Id along : beyond.along)
      if (along >= 0) way_to(along);
  }
  Eigen::MatrixXd of_ways(3, ways.size());
  for (std::size_t k = 0; k < ways.size(); ++k) of_ways.col(k) = ways[k];
  const Eigen::MatrixXd R = of_ways.colPivHouseholderQr().matrixR();
  return std::abs(R(2, 2)) <= kFlat * std::abs(R(0, 0));
}

/// Two nodes that one is between.
struct Pair {
  Id nodes[2], next[2];
  int degree;
  Row between, bend;  // of cubic patches: a - b less as much of those next
};

/// None if it is on no line with them, and nodes beside them cannot mend it.
std::optional<Pair> pair_of(const ReferenceBody& body, Id node, const Across::value_type& a,
                            const Across::value_type& b, const std::vector<Id>& beside) {
  const Vector3 here = body.place(node), ways[] = {body.place(a.first) - here, body.place(b.first) - here};
  if (!(ways[0].dot(ways[1]) < 0.0)) return {};
  const double distances[] = {ways[0].norm(), ways[1].norm()}, both = distances[0] + distances[1];
  const Row line = {{a.first, distances[1] / both}, {b.first, distances[0] / both}};
  auto between = affine_row(body, here, both, 1.0, line, beside);
  if (!between) return {};
  return Pair{{a.first, b.first},
              {a.second.next, b.second.next},
              std::min(a.second.degree, b.second.degree),
              std::move(*between),
              {}};
}

/// Of nodes on seams; first those that are on lines, in both directions where two seams cross, then those
/// whose rows are askew.
std::map<Id, std::vector<Pair>> pairs_of(const ReferenceBody& body, const std::map<Id, Across>& all) {
  std::map<Id, std::vector<Pair>> pairs;
  std::map<Id, std::vector<Id>> askew;  // none yet beside those
  for (const auto& [node, across] : all) {
    std::vector<Pair> found;
    for (auto a = across.begin(); a != across.end(); ++a)
      for (auto b = std::next(a); b != across.end(); ++b)
        if (auto pair = pair_of(body, node, *a, *b, {})) found.push_back(std::move(*pair));
    if (!found.empty())
      pairs.emplace(node, std::move(found));
    else if (sides_of(body, node, across).size() == 1 && is_flat(body, node, across))
      askew[node];
  }
  const auto is_on_seam = [&](Id node) { return pairs.count(node) + askew.count(node) > 0; };
  std::map<Id, int> seams_beside;
  for (const auto& [node, across] : all)
    if (is_on_seam(node))
      for (const auto& [beside, beyond] : across) ++seams_beside[beside];
  // Where three seams meet what is beside one is beside another.
  const auto is_beside_others = [&](Id node) { return is_on_seam(node) || seams_beside.at(node) > 1; };
  const auto beside = [&](const Across& across) {
    std::vector<Id> nodes;
    for (const auto& [node, beyond] : across)
      for (const Id along : beyond.along)
        if (along >= 0 && !is_on_seam(along)) nodes.push_back(along);
    return nodes;
  };
  for (auto& [node, nodes] : askew) nodes = beside(all.at(node));
  for (const auto& [node, nodes] : askew) {
    const auto [a, b] = sides_of(body, node, all.at(node)).front();
    if (is_beside_others(a->first) || is_beside_others(b->first)) continue;
    if (auto pair = pair_of(body, node, *a, *b, nodes)) pairs[node].push_back(std::move(*pair));
  }
  for (auto& [node, own] : pairs)
    for (Pair& pair : own) {
      if (pair.degree < 3 || pair.next[0] < 0 || pair.next[1] < 0) continue;
      const double of_both = (body.place(pair.nodes[0]) - body.place(pair.nodes[1])).norm(),
                   ratio = of_both / (body.place(pair.next[0]) - body.place(pair.next[1])).norm();
      const Row parallel = {
          {pair.nodes[0], 1.0}, {pair.nodes[1], -1.0}, {pair.next[0], -ratio}, {pair.next[1], ratio}};
      if (auto bend = affine_row(body, body.place(node), of_both, 0.0, parallel, beside(all.at(node))))
        pair.bend = std::move(*bend);
    }
  return pairs;
}

const SmoothSeams::Press& press_of(const Pair& pair) { return SmoothSeams::kPress[pair.degree > 2]; }

}  // namespace

SmoothSeams::SmoothSeams(const ReferenceBody& body, const std::vector<SkinPiece>& skin) {
  const std::map<Id, Across> all = nodes_across(body, skin);
  const std::map<Id, std::vector<Pair>> pairs = pairs_of(body, all);
  for (const auto& [node, across] : all)
    if (pairs.count(node) == 0 && !sides_of(body, node, across).empty() && is_flat(body, node, across))
      kinks_.push_back(node);
  const auto first_pair = [&](Id node) {
    const auto found = pairs.find(node);
    return found == pairs.end() ? nullptr : &found->second.front();
  };
  for (const auto& [node, own] : pairs) {
    const Pair& pair = own.front();
    Row& between = between_[node];
    const Pair* const beside[] = {first_pair(pair.nodes[0]), first_pair(pair.nodes[1])};
    for (const auto& [to, share] : pair.between) {
      const Pair* const crossing = first_pair(to);
      add(between, share, crossing ? crossing->between : Row{{to, 1.0}});
    }
    Row kink = {{node, 1.0}};
    for (const Pair& one : own) add(kink, -1.0, one.between);
    const Press& press = press_of(pair);
    if (beside[0] || beside[1]) {  // two seams cross: products of both
      if (!beside[0] || !beside[1] || own.size() != 2) continue;
      add(kink, 1.0, between);
      for (const auto& [met, share] : between)
        add(rows_[met], press.kink[0] * press_of(*beside[0]).kink[0], kink);
      continue;
    }
    for (int k = 0; k < 2; ++k)
      for (int step = 0; step < 2; ++step) {
        const Id met = step == 0 ? pair.nodes[k] : pair.next[k];
        if (met < 0 || pairs.count(met) > 0) continue;
        add(rows_[met], press.kink[step], kink);
        add(rows_[met], k == 0 ? press.bend[step] : -press.bend[step], pair.bend);
      }
  }
  for (auto& [node, row] : rows_) row[node] += 1.0;
  std::map<Id, Row> of_seams;
  for (const auto& [node, between] : between_)
    for (const auto& [beside, share] : between) {
      const auto met = rows_.find(beside);
      add(of_seams[node], share, met == rows_.end() ? Row{{beside, 1.0}} : met->second);
    }
  rows_.insert(of_seams.begin(), of_seams.end());
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

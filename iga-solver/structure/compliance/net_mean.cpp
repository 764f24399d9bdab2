// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/net_mean.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <utility>

#include "structure/conditions/skin_surface.h"

namespace structure {

namespace {

/// Nodes beside each along the nets of the pieces; beyond a seam, if one is there.
std::map<Id, std::set<Id>> neighbours_of(const ReferenceBody& body, const std::vector<SkinPiece>& skin,
                                         const SmoothSeams& seams) {
  std::map<Id, std::set<Id>> found;
  for (const SkinPiece& piece : skin) {
    const SkinSurface surface = skin_surface(body.patches[piece.patch], piece, body.nodes);
    const std::vector<int>& nodes = surface.face.volume_control_point;
    const int counts[] = {surface.face.space.control_point_count(0),
                          surface.face.space.control_point_count(1)};
    const auto add = [&](Id from, Id to) {
      const SmoothSeams::Row* const met = seams.between(to);
      const auto is_from = [&](const auto& beside) { return beside.first == from; };
      if (!met || std::none_of(met->begin(), met->end(), is_from))
        found[from].insert(to);
      else
        for (const auto& [beyond, share] : *met)
          if (beyond != from) found[from].insert(beyond);
    };
    const auto join = [&](int a, int b) {
      if (nodes[a] == nodes[b]) return;  // at a pole
      add(nodes[a], nodes[b]);
      add(nodes[b], nodes[a]);
    };
    for (int j = 0; j < counts[1]; ++j)
      for (int i = 0; i < counts[0]; ++i) {
        const int here = i + counts[0] * j;
        if (i + 1 < counts[0]) join(here, here + 1);
        if (j + 1 < counts[1]) join(here, here + counts[0]);
      }
  }
  return found;
}

/// Two neighbours on opposite sides of a node, and how far they are.
struct Opposite {
  Id nodes[2];
  double distance[2];
};

// Where the net turns by more than an eighth of a circle there are none: at edges, and where it is coarse.
std::vector<Opposite> opposites(const ReferenceBody& body, Id node, const std::set<Id>& neighbours) {
  constexpr double kStraight = -0.7;
  const Vector3 centre = body.place(node);
  struct Way {
    Id node;
    double distance;
    Vector3 direction;
  };
  std::vector<Way> ways;
  for (const Id other : neighbours) {
    const Vector3 way = body.place(other) - centre;
    if (const double distance = way.norm(); distance > 0.0) ways.push_back({other, distance, way / distance});
  }
  struct Candidate {
    double cosine;
    std::size_t a, b;
  };
  std::vector<Candidate> candidates;
  for (std::size_t a = 0; a < ways.size(); ++a)
    for (std::size_t b = a + 1; b < ways.size(); ++b)
      if (const double cosine = ways[a].direction.dot(ways[b].direction); cosine < kStraight)
        candidates.push_back({cosine, a, b});
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& x, const Candidate& y) { return x.cosine < y.cosine; });
  std::vector<Opposite> found;
  std::vector<bool> taken(ways.size(), false);
  for (const auto& [cosine, a, b] : candidates) {
    if (taken[a] || taken[b]) continue;
    taken[a] = taken[b] = true;
    found.push_back({{ways[a].node, ways[b].node}, {ways[a].distance, ways[b].distance}});
  }
  return found;
}

}  // namespace

// Of a node on a seam: what those have that it is met by.
NetMean::NetMean(const ReferenceBody& body, const std::vector<SkinPiece>& skin, const SmoothSeams& seams) {
  constexpr std::size_t kRegular = 2;  // directions of a net
  std::map<Id, std::map<Id, double>> rows;
  for (const auto& [node, neighbours] : neighbours_of(body, skin, seams)) {
    std::map<Id, double>& row = rows[node];
    if (seams.between(node)) continue;
    const std::vector<Opposite> pairs = opposites(body, node, neighbours);
    const double of_pair = 2.0 * kShare * kRegular / static_cast<double>(std::max(kRegular, pairs.size()));
    for (const auto& [nodes, distance] : pairs)
      for (int k = 0; k < 2; ++k) {
        const double share = of_pair * distance[1 - k] / (distance[0] + distance[1]);
        row[nodes[k]] += share;
        row[node] -= share;
      }
  }
  for (auto& [node, row] : rows) {
    if (const SmoothSeams::Row* const met = seams.between(node))
      for (const auto& [beside, part] : *met)
        for (const auto& [to, share] : rows[beside]) row[to] += part * share;
    first_[node] = static_cast<int>(shares_.size());
    for (const auto& [to, share] : row) shares_.push_back({node, to, share});
  }
}

NetMean::Beside NetMean::beside(const SkinPoint& foot) const {
  std::map<Id, double> sums;
  for (std::size_t a = 0; a < foot.nodes.size(); ++a) {
    const Id node = foot.nodes[a];
    sums[node] += 0.0;
    const auto found = first_.find(node);
    if (found == first_.end()) continue;
    for (std::size_t k = found->second; k < shares_.size() && shares_[k].from == node; ++k)
      sums[shares_[k].to] += shares_[k].share * foot.R[a];
  }
  Beside beside;
  for (const auto& [node, Z] : sums) {
    beside.nodes.push_back(node);
    beside.Z.push_back(Z);
  }
  return beside;
}

}  // namespace structure

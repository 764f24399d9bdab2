// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/partition.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

namespace structure {

Partition::Axis Partition::axis(const nurbs::KnotVector& knots, const std::vector<int>& cuts) {
  Axis axis;
  axis.low.assign(knots.control_point_count(), -1);
  axis.high.resize(knots.control_point_count());
  for (std::size_t piece = 0; piece + 1 < cuts.size(); ++piece) {
    const int spans = cuts[piece + 1] - cuts[piece];
    if (cuts.size() > 2 && spans < knots.degree())
      throw std::invalid_argument(fmt::format(
          "Partition: a box of {} knot spans, expected at least {}: the degree", spans, knots.degree()));
    axis.spans.push_back(spans);
    axis.first.push_back(knots.span_of_element(cuts[piece]) - knots.degree());
    axis.end.push_back(knots.span_of_element(cuts[piece + 1] - 1) + 1);
    for (int node = axis.first.back(); node < axis.end.back(); ++node) {
      if (axis.low[node] < 0) axis.low[node] = static_cast<int>(piece);
      axis.high[node] = static_cast<int>(piece);
    }
  }
  return axis;
}

Partition::Partition(const nurbs::Space<3>& space, const BoxCuts& cuts, int parts) {
  for (int d = 0; d < 3; ++d) {
    axes_[d] = axis(space.knots(d), cuts[d]);
    nodes_[d] = space.control_point_count(d);
  }
  part_.resize(std::size_t(piece_count(0)) * piece_count(1) * piece_count(2));
  first_element_.assign(1, 0);
  for (int box = 0; box < box_count(); ++box) {
    const std::array<int, 3> piece = pieces_of(box);
    Id elements = 1;
    for (int d = 0; d < 3; ++d) elements *= axes_[d].spans[piece[d]];
    first_element_.push_back(first_element_.back() + elements);
  }
  divide({{{0, piece_count(0)}, {0, piece_count(1)}, {0, piece_count(2)}}}, 0, parts);
}

/// Halves a brick of boxes across its longest side, as near to the share of the parts as boxes allow.  A
/// single box goes to the first part: the others have none.
void Partition::divide(const Range& boxes, int first_part, int parts) {
  const auto spans = [&](int d, int begin, int end) {
    int sum = 0;
    for (int i = begin; i < end; ++i) sum += axes_[d].spans[i];
    return sum;
  };
  int d = -1;
  for (int e = 0; e < 3; ++e)
    if (boxes[e][1] - boxes[e][0] > 1 &&
        (d < 0 || spans(e, boxes[e][0], boxes[e][1]) > spans(d, boxes[d][0], boxes[d][1])))
      d = e;
  if (parts == 1 || d < 0) {
    for (int k = boxes[2][0]; k < boxes[2][1]; ++k)
      for (int j = boxes[1][0]; j < boxes[1][1]; ++j)
        for (int i = boxes[0][0]; i < boxes[0][1]; ++i) part_[box(i, j, k)] = first_part;
    return;
  }
  const auto [begin, end] = boxes[d];
  const int first_parts = parts / 2;
  const double wanted = static_cast<double>(spans(d, begin, end)) * first_parts / parts;
  int cut = begin + 1;
  while (cut + 1 < end &&
         std::abs(spans(d, begin, cut + 1) - wanted) < std::abs(spans(d, begin, cut) - wanted))
    ++cut;
  Range lower = boxes, upper = boxes;
  lower[d][1] = upper[d][0] = cut;
  divide(lower, first_part, parts / 2);
  divide(upper, first_part + parts / 2, parts - parts / 2);
}

Partition::Boxes Partition::boxes_of(Id node) const {
  const int i = static_cast<int>(node % nodes_[0]), j = static_cast<int>(node / nodes_[0] % nodes_[1]),
            k = static_cast<int>(node / nodes_[0] / nodes_[1]);
  const auto& [x, y, z] = axes_;
  Boxes boxes;
  for (int c = z.low[k]; c <= z.high[k]; ++c)
    for (int b = y.low[j]; b <= y.high[j]; ++b)
      for (int a = x.low[i]; a <= x.high[i]; ++a) boxes.box[boxes.count++] = box(a, b, c);
  return boxes;
}

std::array<int, 3> Partition::pieces_of(int box) const {
  return {box % piece_count(0), box / piece_count(0) % piece_count(1), box / piece_count(0) / piece_count(1)};
}

std::vector<Id> Partition::nodes_of(int box) const {
  const auto [a, b, c] = pieces_of(box);
  const auto& [x, y, z] = axes_;
  std::vector<Id> nodes;
  for (int k = z.first[c]; k < z.end[c]; ++k)
    for (int j = y.first[b]; j < y.end[b]; ++j)
      for (int i = x.first[a]; i < x.end[a]; ++i) nodes.push_back(i + nodes_[0] * (j + Id(nodes_[1]) * k));
  return nodes;
}

std::vector<Id> Partition::elements_of(int box) const {
  std::vector<Id> elements(first_element_[box + 1] - first_element_[box]);
  std::iota(elements.begin(), elements.end(), first_element_[box]);
  return elements;
}

bool Partition::has_ghosts(int box) const {
  const std::vector<Id> nodes = nodes_of(box);
  return std::any_of(nodes.begin(), nodes.end(), [&](Id node) { return owner(node) != part_[box]; });
}

namespace {

/// A share that is told apart.
struct Share {
  Id node;
  int box;
  bool operator<(const Share& other) const {
    return node != other.node ? node < other.node : box < other.box;
  }
};

}  // namespace

/// What part() works with.
class PartBuilder {
 public:
  PartBuilder(const Partition& partition, int p) : partition_(partition), p_(p) {}

  Part build(const std::vector<bool>& has_ghosts) {
    for (const bool border : {true, false})
      for (int box = 0; box < partition_.box_count(); ++box)
        if (partition_.part_of(box) == p_ && has_ghosts[box] == border) part_.boxes.push_back(box);
    part_.border_boxes = static_cast<int>(
        std::count_if(part_.boxes.begin(), part_.boxes.end(), [&](int box) { return has_ghosts[box]; }));
    has_ghosts_ = &has_ghosts;
    take_nodes();
    for (int column = 0; column < part_.held(); ++column) take_shares(column);
    part_.columns = part_.held() + static_cast<int>(shares_.size());
    for (auto& [other, neighbour] : neighbours_) part_.neighbours.push_back(std::move(neighbour));
    for (const int box : part_.boxes) {
      const std::vector<Id> elements = partition_.elements_of(box);
      part_.elements.insert(part_.elements.end(), elements.begin(), elements.end());
      take_tables(box);
    }
    return std::move(part_);
  }

 private:
  /// Owned ones first, each kind rising.
  void take_nodes() {
    std::vector<Id>& nodes = part_.nodes;
    for (const int box : part_.boxes) {
      const std::vector<Id> own = partition_.nodes_of(box);
      nodes.insert(nodes.end(), own.begin(), own.end());
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    const auto ghosts = std::stable_partition(nodes.begin(), nodes.end(),
                                              [&](Id node) { return partition_.owner(node) == p_; });
    part_.owned = static_cast<int>(ghosts - nodes.begin());
    for (int column = 0; column < part_.owned; ++column)
      if (column == 0 || nodes[column] != nodes[column - 1] + 1 ||
          partition_.boxes_of(nodes[column]).box[0] != partition_.boxes_of(nodes[column - 1]).box[0])
        part_.runs.push_back(column);
  }

  /// Boxes of one part that are integrated in their order add to the node itself.
  bool told_apart(const Partition::Boxes& boxes) const {
    const auto kind = [&](int box) { return std::pair(partition_.part_of(box), (*has_ghosts_)[box]); };
    return std::any_of(boxes.box.begin(), boxes.box.begin() + boxes.count,
                       [&](int box) { return kind(box) != kind(boxes.box[0]); });
  }

  void take_shares(int column) {
    const Id node = part_.nodes[column];
    const Partition::Boxes boxes = partition_.boxes_of(node);
    if (!told_apart(boxes)) return;
    const bool owned = column < part_.owned;
    const int owner = partition_.part_of(boxes.box[0]), first = next_column();
    std::vector<int> others;
    for (int b = 0; b < boxes.count; ++b) {
      const int box = boxes.box[b], other = partition_.part_of(box);
      if (!owned && other != p_) continue;
      if (!owned) neighbour(owner).shares_out.push_back(next_column());
      if (owned && other != p_) {
        neighbour(other).shares_in.push_back(next_column());
        others.push_back(other);
      }
      shares_.push_back({node, box});
    }
    if (!owned) return neighbour(owner).ghosts.push_back(column);
    part_.shared.push_back({column, first, next_column()});
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    for (const int other : others) neighbour(other).own.push_back(column);
  }

  void take_tables(int box) {
    std::vector<int>&gather = part_.gather.emplace_back(), &scatter = part_.scatter.emplace_back();
    for (const Id node : partition_.nodes_of(box)) {
      gather.push_back(column_of(node));
      scatter.push_back(told_apart(partition_.boxes_of(node)) ? share_of(node, box) : gather.back());
    }
  }

  int column_of(Id node) const {
    const auto begin = part_.nodes.begin(), ghosts = begin + part_.owned;
    const auto own = std::lower_bound(begin, ghosts, node);
    if (own != ghosts && *own == node) return static_cast<int>(own - begin);
    return static_cast<int>(std::lower_bound(ghosts, part_.nodes.end(), node) - begin);
  }
  int share_of(Id node, int box) const {
    const bool owned = partition_.owner(node) == p_;
    const auto begin = shares_.begin(), ghosts = begin + owned_shares();
    return part_.held() +
           static_cast<int>(
               std::lower_bound(owned ? begin : ghosts, owned ? ghosts : shares_.end(), Share{node, box}) -
               begin);
  }
  long owned_shares() const { return part_.shared.empty() ? 0 : part_.shared.back().end - part_.held(); }
  int next_column() const { return part_.held() + static_cast<int>(shares_.size()); }
  Neighbour& neighbour(int other) {
    Neighbour& neighbour = neighbours_[other];
    neighbour.part = other;
    return neighbour;
  }

  const Partition& partition_;
  int p_;
  Part part_;
  const std::vector<bool>* has_ghosts_ = nullptr;
  std::vector<Share> shares_;  // of owned nodes, then of ghosts, each kind in order
  std::map<int, Neighbour> neighbours_;
};

void add_shares(const Part& part, nurbs::NodalVectors& forces) {
  for (const SharedNode& node : part.shared) {
    nurbs::Vector3 sum = nurbs::Vector3::Zero();
    for (int share = node.first; share < node.end; ++share) sum += forces.col(share);
    forces.col(node.column) = sum;
  }
  forces.rightCols(part.columns - part.held()).setZero();
}

Part Partition::part(int p) const {
  std::vector<bool> ghosts(box_count(), false);
  for (int box = 0; box < box_count(); ++box)
    if (part_[box] == p) ghosts[box] = has_ghosts(box);
  return PartBuilder(*this, p).build(ghosts);
}

}  // namespace structure

// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/partition.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

namespace structure {

PatchBoxes::Axis PatchBoxes::axis(const nurbs::KnotVector& knots, const std::vector<int>& cuts) {
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
    for (int a = axis.first.back(); a < axis.end.back(); ++a) {
      if (axis.low[a] < 0) axis.low[a] = static_cast<int>(piece);
      axis.high[a] = static_cast<int>(piece);
    }
  }
  return axis;
}

PatchBoxes::PatchBoxes(const nurbs::Space<3>& space, const BoxCuts& cuts) {
  for (int d = 0; d < 3; ++d) {
    axes_[d] = axis(space.knots(d), cuts[d]);
    control_points_[d] = space.control_point_count(d);
  }
}

Id PatchBoxes::element_count(int box) const {
  const std::array<int, 3> piece = pieces_of(box);
  Id elements = 1;
  for (int d = 0; d < 3; ++d) elements *= spans(d, piece[d]);
  return elements;
}

std::array<int, 3> PatchBoxes::pieces_of(int box) const {
  return {box % piece_count(0), box / piece_count(0) % piece_count(1), box / piece_count(0) / piece_count(1)};
}

std::vector<int> PatchBoxes::control_points_of(int box) const {
  const auto [a, b, c] = pieces_of(box);
  const auto& [x, y, z] = axes_;
  std::vector<int> points;
  for (int k = z.first[c]; k < z.end[c]; ++k)
    for (int j = y.first[b]; j < y.end[b]; ++j)
      for (int i = x.first[a]; i < x.end[a]; ++i)
        points.push_back(i + control_points_[0] * (j + control_points_[1] * k));
  return points;
}

int PatchBoxes::boxes_of(int control_point, int* boxes) const {
  const int i = control_point % control_points_[0],
            j = control_point / control_points_[0] % control_points_[1],
            k = control_point / control_points_[0] / control_points_[1];
  const auto& [x, y, z] = axes_;
  int count = 0;
  for (int c = z.low[k]; c <= z.high[k]; ++c)
    for (int b = y.low[j]; b <= y.high[j]; ++b)
      for (int a = x.low[i]; a <= x.high[i]; ++a) boxes[count++] = box(a, b, c);
  return count;
}

Partition::Partition(const nurbs::Space<3>& space, const BoxCuts& cuts, int parts)
    : Partition({PatchBoxes(space, cuts)}, NodeNumbering({space.control_point_count()}), parts) {}

Partition::Partition(std::vector<PatchBoxes> patches, NodeNumbering nodes, int parts)
    : patches_(std::move(patches)), nodes_(std::move(nodes)), first_box_{0}, first_element_{0} {
  std::vector<Id> elements{0};  // of the patches before
  for (const PatchBoxes& patch : patches_) {
    for (int box = 0; box < patch.count(); ++box)
      first_element_.push_back(first_element_.back() + patch.element_count(box));
    first_box_.push_back(first_box_.back() + patch.count());
    elements.push_back(first_element_.back());
  }
  part_.resize(first_box_.back());
  const auto share = [&](Id before) {
    return static_cast<double>(before) * parts / static_cast<double>(elements.back());
  };
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    const PatchBoxes& patch = patches_[p];
    divide(static_cast<int>(p),
           {{{0, patch.piece_count(0)}, {0, patch.piece_count(1)}, {0, patch.piece_count(2)}}},
           {share(elements[p]), share(elements[p + 1])});
  }
  weld_boxes();
}

/// Cuts a brick of boxes across its longest side, as near to the shares of the parts as boxes allow.  A
/// single box goes to the part that has the most of it.
void Partition::divide(int patch, const Range& boxes, const Shares& shares) {
  const PatchBoxes& all = patches_[patch];
  const auto spans = [&](int d, int begin, int end) {
    int sum = 0;
    for (int i = begin; i < end; ++i) sum += all.spans(d, i);
    return sum;
  };
  int d = -1;
  for (int e = 0; e < 3; ++e)
    if (boxes[e][1] - boxes[e][0] > 1 &&
        (d < 0 || spans(e, boxes[e][0], boxes[e][1]) > spans(d, boxes[d][0], boxes[d][1])))
      d = e;
  const int first = static_cast<int>(std::floor(shares.begin)),
            last = static_cast<int>(std::ceil(shares.end)) - 1;
  if (first >= last || d < 0) {
    int part = first;
    const auto share = [&](int p) {
      return std::min(p + 1.0, shares.end) - std::max<double>(p, shares.begin);
    };
    for (int p = first + 1; p <= last; ++p)
      if (share(p) > share(part)) part = p;
    for (int k = boxes[2][0]; k < boxes[2][1]; ++k)
      for (int j = boxes[1][0]; j < boxes[1][1]; ++j)
        for (int i = boxes[0][0]; i < boxes[0][1]; ++i) part_[first_box_[patch] + all.box(i, j, k)] = part;
    return;
  }
  const auto [begin, end] = boxes[d];
  const int middle = (first + last + 1) / 2;  // a whole number of parts
  const double wanted = spans(d, begin, end) * (middle - shares.begin) / (shares.end - shares.begin);
  int cut = begin;
  while (cut < end && std::abs(spans(d, begin, cut + 1) - wanted) < std::abs(spans(d, begin, cut) - wanted))
    ++cut;
  Range lower = boxes, upper = boxes;
  lower[d][1] = upper[d][0] = cut;
  if (cut > begin) divide(patch, lower, {shares.begin, double(middle)});
  if (cut < end) divide(patch, upper, {double(middle), shares.end});
}

void Partition::weld_boxes() {
  for (std::size_t i = 0; i < nodes_.welded().size(); ++i) {
    std::vector<int>& boxes = welded_boxes_.emplace_back();
    for (const auto& [patch, control_point] : nodes_.places_of_welded(i)) {
      std::array<int, 8> own;
      const int count = patches_[patch].boxes_of(control_point, own.data());
      for (int b = 0; b < count; ++b) boxes.push_back(first_box_[patch] + own[b]);
    }
    std::sort(boxes.begin(), boxes.end());
    boxes.erase(std::unique(boxes.begin(), boxes.end()), boxes.end());
  }
}

Partition::Boxes Partition::boxes_of(Id node) const {
  Boxes boxes;
  const std::vector<Id>& welded = nodes_.welded();
  if (const auto found = std::lower_bound(welded.begin(), welded.end(), node);
      found != welded.end() && *found == node) {
    boxes.many_ = &welded_boxes_[found - welded.begin()];
    return boxes;
  }
  const NodeNumbering::Place place = nodes_.place(node);
  boxes.count_ = patches_[place.patch].boxes_of(place.control_point, boxes.few_.data());
  for (std::size_t b = 0; b < boxes.count_; ++b) boxes.few_[b] += first_box_[place.patch];
  return boxes;
}

int Partition::patch_of(int box) const {
  return static_cast<int>(std::upper_bound(first_box_.begin(), first_box_.end(), box) - first_box_.begin()) -
         1;
}

std::vector<Id> Partition::nodes_of(int box) const {
  const int patch = patch_of(box);
  std::vector<Id> nodes;
  for (const int point : patches_[patch].control_points_of(box - first_box_[patch]))
    nodes.push_back(nodes_.node(patch, point));
  return nodes;
}

bool Partition::has_ghosts(int box) const {
  const std::vector<Id> nodes = nodes_of(box);
  return std::any_of(nodes.begin(), nodes.end(), [&](Id node) { return owner(node) != part_[box]; });
}

/// What part() works with.
class PartBuilder {
 public:
  PartBuilder(const Partition& partition, int p) : partition_(partition), p_(p) {}

  Part build(const std::vector<bool>& has_ghosts) {
    for (int patch = 0; patch < partition_.patch_count(); ++patch) take_boxes(patch, has_ghosts);
    has_ghosts_ = &has_ghosts;
    take_nodes();
    for (int column = 0; column < part_.held(); ++column) take_shares(column);
    part_.columns = part_.held() + static_cast<int>(shares_.size());
    for (auto& [other, neighbour] : neighbours_) part_.neighbours.push_back(std::move(neighbour));
    for (const int box : part_.boxes) {
      part_.elements.push_back({partition_.first_element(box), part_.element_count});
      part_.element_count += partition_.element_count(box);
      take_tables(box);
    }
    return std::move(part_);
  }

 private:
  /// A share that is told apart.
  struct Share {
    Id node;
    int box;
    bool operator<(const Share& other) const {
      return node != other.node ? node < other.node : box < other.box;
    }
  };

  void take_boxes(int patch, const std::vector<bool>& has_ghosts) {
    const int begin = static_cast<int>(part_.boxes.size()), first = partition_.first_box(patch);
    int border = 0;
    for (const bool ghosts : {true, false}) {
      for (int box = first; box < partition_.first_box(patch + 1); ++box)
        if (partition_.part_of(box) == p_ && has_ghosts[box] == ghosts) part_.boxes.push_back(box);
      if (ghosts) border = static_cast<int>(part_.boxes.size()) - begin;
    }
    part_.patches.push_back({begin, static_cast<int>(part_.boxes.size()), border, first});
  }

  /// Owned ones first, each kind rising.
  void take_nodes() {
    std::vector<Id>& nodes = part_.nodes;
    for (const int box : part_.boxes) {
      const std::vector<Id> own = partition_.nodes_of(box);
      nodes.insert(nodes.end(), own.begin(), own.end());
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    nodes.shrink_to_fit();
    const auto ghosts = std::stable_partition(nodes.begin(), nodes.end(),
                                              [&](Id node) { return partition_.owner(node) == p_; });
    part_.owned = static_cast<int>(ghosts - nodes.begin());
    for (int column = 0; column < part_.owned; ++column)
      if (column == 0 || nodes[column] != nodes[column - 1] + 1 ||
          partition_.boxes_of(nodes[column])[0] != partition_.boxes_of(nodes[column - 1])[0])
        part_.runs.push_back(column);
  }

  /// Boxes of one part that are integrated in their order add to the node itself.
  bool told_apart(const Partition::Boxes& boxes) const {
    const auto kind = [&](int box) { return std::pair(partition_.part_of(box), (*has_ghosts_)[box]); };
    return std::any_of(boxes.begin(), boxes.end(), [&](int box) { return kind(box) != kind(boxes[0]); });
  }

  void take_shares(int column) {
    const Id node = part_.nodes[column];
    const Partition::Boxes boxes = partition_.boxes_of(node);
    if (!told_apart(boxes)) return;
    const bool owned = column < part_.owned;
    const int owner = partition_.part_of(boxes[0]), first = next_column();
    std::vector<int> others;
    for (const int box : boxes) {
      const int other = partition_.part_of(box);
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

Id Part::element(Id held) const {
  const auto box = std::upper_bound(elements.begin(), elements.end(), held,
                                    [](Id number, const Elements& some) { return number < some.begin; }) -
                   1;
  return box->first + held - box->begin;
}

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

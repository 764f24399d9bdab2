// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/piece_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "brep/bounds.h"

namespace brep {
namespace {

constexpr int kLeaf = 8;            // pieces at most
constexpr float kRoundOff = 5e-7f;  // of sums of three products, and of points in units, with room
constexpr float kRoundOffOfSquares = 4.0f * kRoundOff;

float rounded_up(double x) { return static_cast<float>(x) * (1.0f + kRoundOff) + kRoundOff; }

}  // namespace

struct PieceTree::Boxes {
  std::vector<Eigen::Vector3f> low, high;
  std::vector<std::int32_t> piece;
};

PieceTree::PieceTree(const Surface& surface) : discs_(surface.pieces.size()) {
  units_.set(surface.low, surface.high);
  Boxes boxes;
  const int pieces = static_cast<int>(surface.pieces.size());
  boxes.low.reserve(pieces);
  boxes.high.reserve(pieces);
  boxes.piece.reserve(pieces);
  std::vector<Bounds> of_piece;
  for (int p = 0; p < pieces; ++p) {
    of_piece.clear();
    add_boxes(surface, surface.pieces[p], of_piece);
    set_disc(surface, p, of_piece);
    for (const Bounds& box : of_piece) {
      boxes.low.emplace_back(units_.in_units(box.low).cast<float>().array() - kRoundOff);
      boxes.high.emplace_back(units_.in_units(box.high).cast<float>().array() + kRoundOff);
      boxes.piece.push_back(p);
    }
  }
  const int count = static_cast<int>(boxes.piece.size());
  if (count > pieces) keep_parts(boxes, pieces);
  order_.resize(count);
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(count / 2 + 1);
  if (count > 0) build(boxes, 0, count);
  for (std::int32_t& box : order_) box = boxes.piece[box];
}

// Those of a piece fill whole groups of groups: the last box stands there several times.
void PieceTree::keep_parts(const Boxes& boxes, int pieces) {
  constexpr int kWhole = kGroup * kGroup;
  const int count = static_cast<int>(boxes.piece.size());
  first_part_.assign(1, 0);
  for (int p = 0, begin = 0; p < pieces; ++p) {
    int end = begin;
    while (end < count && boxes.piece[end] == p) ++end;
    const int kept = end - begin > 1 ? (end - begin + kWhole - 1) / kWhole * kWhole : 0;
    for (int k = begin; k < begin + kept; ++k)
      for (int i = 0; i < 3; ++i) {
        part_low_[i].push_back(boxes.low[std::min(k, end - 1)][i]);
        part_high_[i].push_back(boxes.high[std::min(k, end - 1)][i]);
      }
    first_part_.push_back(static_cast<std::int32_t>(part_low_[0].size()));
    begin = end;
  }
  for (int i = 0; i < 3; ++i)
    for (auto low = part_low_[i].begin(), high = part_high_[i].begin(); low != part_low_[i].end();
         low += kGroup, high += kGroup) {
      group_low_[i].push_back(*std::min_element(low, low + kGroup));
      group_high_[i].push_back(*std::max_element(high, high + kGroup));
    }
}

// Squared distance from as many boxes as a group has.
inline PieceTree::OfGroup PieceTree::off2(const Query& query, const std::vector<float> (&low)[3],
                                          const std::vector<float> (&high)[3], int first) {
  OfGroup sum = OfGroup::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Map<const OfGroup> from(&low[i][first]), to(&high[i][first]);
    sum += (from - query.d[i]).max(query.d[i] - to).max(0.0f).square();
  }
  return sum;
}

// Boxes are looked at in groups, of which most are too far.  What query() adds to a reach is taken off here.
double PieceTree::distance_of_boxes(const Query& query, int first, int end) const {
  const float beyond2 = std::nextafter(query.reach * query.reach, std::numeric_limits<float>::infinity());
  float least2 = beyond2;
  for (int groups = first; groups < end; groups += kGroup * kGroup) {
    const OfGroup of_groups = off2(query, group_low_, group_high_, groups / kGroup);
    for (int k = 0; k < kGroup; ++k)
      if (of_groups[k] < least2)
        least2 = std::min(least2, off2(query, part_low_, part_high_, groups + kGroup * k).minCoeff());
  }
  if (!(least2 < beyond2)) return std::numeric_limits<double>::infinity();
  const double least = std::sqrt(static_cast<double>(least2));
  const double far = std::abs(query.d[0]) + std::abs(query.d[1]) + std::abs(query.d[2]);
  const double sure = least * (1.0 - kRoundOffOfSquares) - kRoundOff * (1.0 + far);
  return std::max(0.0, sure) / units_.in_units(1.0);
}

void PieceTree::set_disc(const Surface& surface, int p, const std::vector<Bounds>& boxes) {
  const Piece& piece = surface.pieces[p];
  Circle circle;
  Vector3 normal = Vector3::Zero();
  double thickness = 0.0;
  if (piece.triangle()) {
    const auto corner = [&](int i) { return units_.in_units(surface.vertices[piece.vertex[i]].point); };
    circle = circle_around(corner(0), corner(1), corner(2));
    normal = surface.faces[piece.face].frame.z;
    for (int i = 0; i < 3; ++i)
      thickness = std::max(thickness, std::abs(normal.dot(corner(i) - circle.centre)));
  } else {
    Bounds box{Vector3::Zero(), Vector3::Zero()};  // of a face of which nothing is left
    if (!boxes.empty()) box = boxes.front();
    for (const Bounds& part : boxes) box = {box.low.cwiseMin(part.low), box.high.cwiseMax(part.high)};
    circle = {units_.in_units(0.5 * (box.low + box.high)),
              0.5 * (units_.in_units(box.high) - units_.in_units(box.low)).norm()};
  }
  Disc& disc = discs_[p];
  for (int i = 0; i < 3; ++i) {
    disc.centre[i] = static_cast<float>(circle.centre[i]);
    disc.normal[i] = static_cast<float>(normal[i]);
  }
  disc.radius = rounded_up(circle.radius);
  disc.thickness = rounded_up(thickness + kRoundOff * circle.radius);
}

void PieceTree::build(const Boxes& boxes, int first, int count) {
  Eigen::Vector3f low = boxes.low[order_[first]], high = boxes.high[order_[first]];
  Eigen::Vector3f middle_low = low + high, middle_high = middle_low;
  for (int i = first + 1; i < first + count; ++i) {
    const Eigen::Vector3f &a = boxes.low[order_[i]], &b = boxes.high[order_[i]];
    low = low.cwiseMin(a);
    high = high.cwiseMax(b);
    middle_low = middle_low.cwiseMin(a + b);
    middle_high = middle_high.cwiseMax(a + b);
  }
  const size_t node = nodes_.size();
  nodes_.push_back({{low[0], low[1], low[2]}, {high[0], high[1], high[2]}, first, count});
  if (count <= kLeaf) return;
  int axis;
  (middle_high - middle_low).maxCoeff(&axis);
  const auto begin = order_.begin() + first;
  const int half = count / 2;
  std::nth_element(begin, begin + half, begin + count, [&](int p, int q) {
    return boxes.low[p][axis] + boxes.high[p][axis] < boxes.low[q][axis] + boxes.high[q][axis];
  });
  build(boxes, first, half);
  nodes_[node].first = static_cast<std::int32_t>(nodes_.size());
  nodes_[node].count = 0;
  build(boxes, first + half, count - half);
}

// As BoxUnits::limit, without roots.
PieceTree::Query PieceTree::query(const Vector3& d, double reach) const {
  constexpr double kHalfUlp = search::BoxUnits::kHalfUlp;
  const Vector3 x = units_.in_units(d);
  const double far = x.cwiseAbs().sum();  // from the centre, at most
  const double moved = (units_.in_units(reach) + 3.0 * kHalfUlp * far) * (1.0 + 8.0 * kHalfUlp);
  const float limit = static_cast<float>(moved) * (1.0f + kRoundOffOfSquares) + kRoundOff;
  return {{static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])}, limit};
}

void PieceTree::near(const Query& query, std::vector<int>& pieces) const {
  if (nodes_.empty()) return;
  std::int32_t stack[64];
  int depth = 0;
  stack[depth++] = 0;
  const float far2 = query.reach * query.reach;
  while (depth > 0) {
    const std::int32_t n = stack[--depth];
    const Node& node = nodes_[n];
    float sum = 0.0f;
    for (int i = 0; i < 3; ++i) {
      const float off = std::max({node.low[i] - query.d[i], query.d[i] - node.high[i], 0.0f});
      sum += off * off;
    }
    if (sum > far2) continue;
    if (node.count == 0) {
      stack[depth++] = node.first;
      stack[depth++] = n + 1;
      continue;
    }
    const std::size_t before = pieces.size();
    pieces.resize(before + node.count);
    pieces.resize(before + filter(query, &order_[node.first], node.count, &pieces[before]));
  }
}

}  // namespace brep

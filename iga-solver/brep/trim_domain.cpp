// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/trim_domain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace brep {
namespace {

constexpr int kDeepest = 48;      // halvings of a curve until it rises or falls all the way
constexpr int kBisections = 60;   // to the last bit
constexpr int kBoxHalvings = 6;   // of a curve that may meet a box
constexpr double kLevel = 1e-14;  // of the loops' extent: nothing rises or falls there
constexpr double kWider = 1.0 + 1e-9;

using Box2 = std::pair<Parameter<2>, Parameter<2>>;

Box2 box_of(const BezierCurve<2>& curve) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box2 box{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
  for (int k = 0; k <= curve.degree(); ++k)
    for (int i = 0; i < 2; ++i) {
      box.first[i] = std::min(box.first[i], curve.point(k)[i]);
      box.second[i] = std::max(box.second[i], curve.point(k)[i]);
    }
  return box;
}

bool apart(const Parameter<2>& low, const Parameter<2>& high, const Box2& box) {
  return low[0] > box.second[0] || high[0] < box.first[0] || low[1] > box.second[1] || high[1] < box.first[1];
}

// How often its polygon turns from rising to falling or back along xi1; a curve turns no more often.
int turns(const BezierCurve<2>& curve) {
  int count = 0, last = 0;
  for (int k = 0; k < curve.degree(); ++k) {
    const double rise = curve.point(k + 1)[1] - curve.point(k)[1];
    const int sign = rise > 0.0 ? 1 : rise < 0.0 ? -1 : 0;
    if (sign != 0 && last != 0 && sign != last) ++count;
    if (sign != 0) last = sign;
  }
  return count;
}

// Of a curve with one turn.
double turning_point(const BezierCurve<2>& curve) {
  double low = 0.0, high = 1.0;
  const bool rises = curve.point(1)[1] > curve.point(0)[1] || curve.derivatives(0.0).first[1] > 0.0;
  for (int k = 0; k < kBisections; ++k) {
    const double s = 0.5 * (low + high);
    ((curve.derivatives(s).first[1] > 0.0) == rises ? low : high) = s;
  }
  return 0.5 * (low + high);
}

}  // namespace

TrimDomain::TrimDomain(const std::vector<Loop>& loops) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  low_ = {kInfinity, kInfinity}, high_ = {-kInfinity, -kInfinity};
  for (const Loop& loop : loops)
    for (const Trim& trim : loop)
      for (int k = 0; k < trim.curve.points.cols(); ++k)
        for (int i = 0; i < 2; ++i) {
          low_[i] = std::min(low_[i], trim.curve.points(i, k));
          high_[i] = std::max(high_[i], trim.curve.points(i, k));
        }
  if (!(low_[0] < high_[0] && low_[1] < high_[1])) throw std::invalid_argument("loops without extent");
  for (const Loop& loop : loops) add_loop(loop);
  for (int i = 0; i < 2; ++i) {  // of the curves, now that they are known, and not of their polygons
    low_[i] = kInfinity, high_[i] = -kInfinity;
    for (const Part& part : parts_) {
      low_[i] = std::min(low_[i], part.low[i]);
      high_[i] = std::max(high_[i], part.high[i]);
    }
  }
  make_bands();
}

void TrimDomain::add_loop(const Loop& loop) {
  const size_t first = parts_.size();
  for (const Trim& trim : loop)
    for (const BezierCurve<2>& curve : beziers(trim.curve)) {
      if (parts_.size() > first) add_line(parts_.back().to, curve.point(0));
      add_curve(curve, 0);
    }
  if (parts_.size() > first) add_line(parts_.back().to, parts_[first].from);
}

void TrimDomain::add_line(const Point& from, const Point& to) {
  if (from != to) add_part(from, to, nullptr);
}

void TrimDomain::add_curve(const BezierCurve<2>& curve, int depth) {
  const int p = curve.degree();
  if (p == 1) return add_line(curve.point(0), curve.point(1));
  const Box2 box = box_of(curve);
  const int bends = turns(curve);
  if (bends == 0 || depth == kDeepest || box.second[1] - box.first[1] <= kLevel * (high_[1] - low_[1]))
    return add_small_parts(curve, 0);
  const auto [before, behind] = curve.parts(bends == 1 ? turning_point(curve) : 0.5);
  if (bends == 1) {
    add_small_parts(before, 0);
    return add_small_parts(behind, 0);
  }
  add_curve(before, depth + 1);
  add_curve(behind, depth + 1);
}

// In boxes so small that few points are in one.
void TrimDomain::add_small_parts(const BezierCurve<2>& curve, int depth) {
  constexpr double kSmall = 1.0 / 64.0;  // of the loops' extent
  constexpr int kMostHalvings = 8;
  const Box2 box = box_of(curve);
  const bool is_small = box.second[0] - box.first[0] <= kSmall * (high_[0] - low_[0]) ||
                        box.second[1] - box.first[1] <= kSmall * (high_[1] - low_[1]);
  if (is_small || depth == kMostHalvings)
    return add_part(curve.point(0), curve.point(curve.degree()), &curve);
  const auto [before, behind] = curve.parts(0.5);
  add_small_parts(before, depth + 1);
  add_small_parts(behind, depth + 1);
}

void TrimDomain::add_part(const Point& from, const Point& to, const BezierCurve<2>* curve) {
  Part part{from, to, -1, {}, {}, 0.0};
  for (int i = 0; i < 2; ++i) {
    part.low[i] = std::min(from[i], to[i]);
    part.high[i] = std::max(from[i], to[i]);
  }
  if (curve != nullptr) {
    const Box2 box = box_of(*curve);
    part.low[0] = std::min(part.low[0], box.first[0]);
    part.high[0] = std::max(part.high[0], box.second[0]);
    for (int k = 1; k < curve->degree(); ++k)
      part.bulge = std::max(part.bulge, kWider * std::abs(part.beyond(curve->point(k))));
    part.curve = static_cast<int>(curves_.size());
    curves_.push_back(*curve);
  }
  parts_.push_back(part);
}

void TrimDomain::make_bands() {
  const int count = std::clamp(static_cast<int>(parts_.size()), 1, 256);
  bands_per_length_ = count / (high_[1] - low_[1]);
  std::vector<std::vector<int>> bands(count);
  const auto band = [&](double v) {
    return std::clamp(static_cast<int>((v - low_[1]) * bands_per_length_), 0, count - 1);
  };
  for (size_t k = 0; k < parts_.size(); ++k)
    if (parts_[k].low[1] < parts_[k].high[1])
      for (int b = band(parts_[k].low[1]); b <= band(parts_[k].high[1]); ++b)
        bands[b].push_back(static_cast<int>(k));
  first_.assign(1, 0);
  for (const std::vector<int>& parts : bands) {
    in_band_.insert(in_band_.end(), parts.begin(), parts.end());
    first_.push_back(static_cast<int>(in_band_.size()));
  }
}

// Parts that a ray along xi0 meets; where two parts meet, the one that goes on upwards.
bool TrimDomain::inside(const Parameter<2>& xi) const {
  const double place = (xi[1] - low_[1]) * bands_per_length_;
  const int count = static_cast<int>(first_.size()) - 1;
  if (!(xi[1] >= low_[1] && xi[1] <= high_[1] && xi[0] >= low_[0] && xi[0] <= high_[0])) return false;
  const int b = std::min(static_cast<int>(place), count - 1);
  bool odd = false;
  for (int k = first_[b]; k < first_[b + 1]; ++k) {
    const Part& part = parts_[in_band_[k]];
    if (part.low[1] <= xi[1] && xi[1] < part.high[1] && is_left_of(part, xi)) odd = !odd;
  }
  return odd;
}

bool TrimDomain::is_left_of(const Part& part, const Parameter<2>& xi) const {
  if (xi[0] < part.low[0]) return true;
  if (xi[0] >= part.high[0]) return false;
  const double rise = part.to[1] - part.from[1];
  const double across = part.beyond({xi[0], xi[1]});
  if (part.curve < 0 || std::abs(across) > part.bulge) return rise > 0.0 ? across > 0.0 : across < 0.0;
  return xi[0] < crossing(part, xi[1])[0];
}

// Where a part that rises or falls all the way has this xi1: Newton's method between its ends.
TrimDomain::Point TrimDomain::crossing(const Part& part, double xi1) const {
  constexpr double kLastStep = 1e-9;  // one that is no longer leaves an error of its square
  const bool rises = part.to[1] > part.from[1];
  double low = 0.0, high = 1.0, s = (xi1 - part.from[1]) / (part.to[1] - part.from[1]);
  for (int k = 0; k < kBisections; ++k) {
    const auto at = curves_[part.curve].derivatives(s);
    const double off = at.point[1] - xi1;
    ((off < 0.0) == rises ? low : high) = s;
    double next = s - off / at.first[1];
    const bool is_between = next >= low && next <= high;
    if (!is_between) next = 0.5 * (low + high);
    const bool done = is_between && std::abs(next - s) <= kLastStep;
    s = next;
    if (done) break;
  }
  return curves_[part.curve].at(s);
}

TrimDomain::Where TrimDomain::where(const Parameter<2>& low, const Parameter<2>& high) const {
  for (const Part& part : parts_)
    if (meets(part, low, high)) return Where::cut;
  return inside({0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])}) ? Where::inside : Where::outside;
}

std::vector<TrimDomain::Segment> TrimDomain::segments(
    const std::function<bool(const Parameter<2>&, const Parameter<2>&)>& is_straight) const {
  constexpr int kMostHalvings = 12;
  std::vector<Segment> result;
  const std::function<void(const Part&, double, const Point&, double, const Point&, int)> add =
      [&](const Part& part, double s, const Point& from, double t, const Point& to, int depth) {
        const Parameter<2> a{from[0], from[1]}, b{to[0], to[1]};
        const bool coarse = depth == 0 && part.curve >= 0;  // a curve may come back to where it began
        if (depth == kMostHalvings || (!coarse && is_straight(a, b)))
          return result.emplace_back(a, b), void();
        const double half = 0.5 * (s + t);
        const Point middle = part.curve < 0 ? Point(0.5 * (from + to)) : curves_[part.curve].at(half);
        add(part, s, from, half, middle, depth + 1);
        add(part, half, middle, t, to, depth + 1);
      };
  for (const Part& part : parts_) add(part, 0.0, part.from, 1.0, part.to, 0);
  return result;
}

bool TrimDomain::meets(const Part& part, const Parameter<2>& low, const Parameter<2>& high) const {
  if (apart(low, high, {part.low, part.high})) return false;
  if (part.curve < 0) {  // all corners of the box beyond the line?
    const Point way = part.to - part.from;
    int above = 0;
    for (int c = 0; c < 4; ++c) {
      const Point corner(c % 2 == 0 ? low[0] : high[0], c < 2 ? low[1] : high[1]);
      above += static_cast<int>(way[0] * (corner[1] - part.from[1]) > way[1] * (corner[0] - part.from[0]));
    }
    return above % 4 != 0;
  }
  std::vector<std::pair<BezierCurve<2>, int>> left{{curves_[part.curve], 0}};
  while (!left.empty()) {
    const auto [curve, depth] = left.back();
    left.pop_back();
    if (apart(low, high, box_of(curve))) continue;
    if (depth == kBoxHalvings) return true;
    const auto [before, behind] = curve.parts(0.5);
    left.emplace_back(before, depth + 1);
    left.emplace_back(behind, depth + 1);
  }
  return false;
}

}  // namespace brep

// SPDX-License-Identifier: GPL-2.0-or-later
#include "search/element_descent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "nurbs/assert.h"

namespace search {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr int kMaxIterations = 60;

double square(double x) { return x * x; }

// Minimum of g.s + s.H s / 2 over low <= s <= high, H positive definite.
void minimise(const double (&g)[2], const double (&H)[3], const double (&low)[2], const double (&high)[2],
              double (&step)[2]) {
  const double inverse_det = 1.0 / (H[0] * H[2] - H[1] * H[1]);
  step[0] = (H[1] * g[1] - H[2] * g[0]) * inverse_det;
  step[1] = (H[1] * g[0] - H[0] * g[1]) * inverse_det;
  if (low[0] <= step[0] && step[0] <= high[0] && low[1] <= step[1] && step[1] <= high[1]) return;

  double least = std::numeric_limits<double>::infinity();
  for (int fixed = 0; fixed < 2; ++fixed)
    for (const double bound : {low[fixed], high[fixed]}) {
      const int other = 1 - fixed;
      double s[2];
      s[fixed] = bound;
      s[other] = std::clamp(-(g[other] + H[1] * bound) / H[2 * other], low[other], high[other]);
      const double value = g[0] * s[0] + g[1] * s[1] +
                           0.5 * (H[0] * s[0] * s[0] + 2.0 * H[1] * s[0] * s[1] + H[2] * s[1] * s[1]);
      if (value < least) least = value, step[0] = s[0], step[1] = s[1];
    }
}

class Descent {
 public:
  Descent(const ElementStore& elements, const Vector3& d, const LocalPoint& start, const LocalBox* box)
      : elements_(elements), d_{d[0], d[1], d[2]}, box_(box) {
    now_->at = start;
    sample(*now_);
  }

  DescentResult run() {
    DescentResult result{};
    result.end = DescentEnd::unknown;
    while (result.iterations < kMaxIterations) {
      ++result.iterations;
      propose();
      if (last_step()) {
        if (box_ == nullptr && ends_on_crease() && advance()) continue;
        if (convex_ && box_ == nullptr && cross_crease()) continue;
        result.end = classify();
        break;
      }
      if (!advance()) break;
    }
    result.r = result.end == DescentEnd::unknown ? Vector3(now_->f.r) : finish();
    for (int i = 0; i < 2; ++i) result.crease[i] = kink(i);
    result.at = now_->at;
    return result;
  }

 private:
  struct State {
    LocalPoint at;
    double size;  // of the element
    DistanceJet f;
  };
  void sample(State& state) const {
    const ElementStore::Element element = elements_.element(state.at.e);
    const ElementKernel& kernel = elements_.kernel();
    state.size = element.size();
    kernel.evaluate(kernel.p, kernel.q, element.row, state.at.s, d_, state.f);
  }

  // The border of the box or of the region between creases, in the coordinates of the current element.
  double low(int i) const { return box_ ? box_->low[i] : elements_.axis(i, now_->at.e[i]).low; }
  double high(int i) const { return box_ ? box_->high[i] : elements_.axis(i, now_->at.e[i]).high; }

  bool convex_on(const bool (&free)[2]) const {
    const double(&H)[3] = now_->f.hessian, (&A)[3] = now_->f.metric;
    return (!free[0] || H[0] > kLeastCurvature * A[0]) && (!free[1] || H[2] > kLeastCurvature * A[2]) &&
           (!free[0] || !free[1] || H[0] * H[2] - H[1] * H[1] > kLeastCurvature * H[0] * H[2]);
  }

  // The Newton step, and whether phi is convex in the directions that have room.
  void propose() {
    double room_low[2], room_high[2];
    for (int i = 0; i < 2; ++i) {
      const double below = low(i) - now_->at.s[i], above = high(i) - now_->at.s[i];
      const double slope = clear_slope(i);
      held_[i] = (below >= 0.0 && slope > 0.0) || (above <= 0.0 && slope < 0.0) || below >= above;
      room_low[i] = held_[i] ? 0.0 : below;
      room_high[i] = held_[i] ? 0.0 : above;
    }
    const double(&H)[3] = now_->f.hessian, (&A)[3] = now_->f.metric, (&g)[2] = now_->f.gradient;
    const double det = H[0] * H[2] - H[1] * H[1];
    const bool free[2] = {!held_[0], !held_[1]};
    convex_ = convex_on(free);
    if (!convex_) return reflected_step(room_low, room_high);
    if (held_[0] || held_[1]) {
      conditioning_ = 1.0;
      for (int i = 0; i < 2; ++i) {
        step_[i] = held_[i] ? 0.0 : std::clamp(-g[i] / H[2 * i], room_low[i], room_high[i]);
        if (!held_[i]) conditioning_ = std::min(1.0, H[2 * i] / A[2 * i]);
      }
      return;
    }
    // Between the lesser curvature and twice that: the product of both over their mean.
    conditioning_ = std::min(1.0, 2.0 * det / (H[0] * A[2] + H[2] * A[0]));
    minimise(g, H, room_low, room_high, step_);
  }

  // The Hessian with its eigenvalues, per unit length, made positive (Nocedal & Wright 2006, section 3.4),
  // and no step beyond a quarter of the region.
  void reflected_step(const double (&room_low)[2], const double (&room_high)[2]) {
    constexpr double kFloor = 0.1;
    conditioning_ = 1.0;
    const double largest = std::max(now_->f.metric[0], now_->f.metric[2]);
    double v[2], low_v[2], high_v[2], g[2];
    for (int i = 0; i < 2; ++i) {
      v[i] = std::sqrt(std::max(now_->f.metric[2 * i], 1e-12 * largest));
      const double trusted = std::max(0.5, 0.25 * (high(i) - low(i)));
      low_v[i] = v[i] * std::max(room_low[i], -trusted);
      high_v[i] = v[i] * std::min(room_high[i], trusted);
      g[i] = now_->f.gradient[i] / v[i];
    }
    const bool both = !held_[0] && !held_[1];
    const double a = held_[0] ? 0.0 : now_->f.hessian[0] / square(v[0]),
                 b = both ? now_->f.hessian[1] / (v[0] * v[1]) : 0.0,
                 c = held_[1] ? 0.0 : now_->f.hessian[2] / square(v[1]);
    // |H| is the root of H^2: (H^2 + det I) / sqrt(trace + 2 det), det that of |H|, trace that of H^2.
    const double det = std::abs(a * c - b * b), trace = a * a + 2.0 * b * b + c * c;
    const double inverse = trace > 0.0 ? 1.0 / std::sqrt(trace + 2.0 * det) : 0.0;
    const double H[3] = {(a * a + b * b + det) * inverse + kFloor, b * (a + c) * inverse,
                         (b * b + c * c + det) * inverse + kFloor};
    minimise(g, H, low_v, high_v, step_);
    for (int i = 0; i < 2; ++i) step_[i] /= v[i];
  }

  // The gradient, or 0 where it is round-off (a stationary point on a border may be a maximum).
  double clear_slope(int i) const {
    const double g = now_->f.gradient[i];
    return square(g) > 256.0 * round_off2() * now_->f.metric[2 * i] ? g : 0.0;
  }

  // Lengths below this are round-off of the evaluation.
  double round_off2() const { return square(kRoundOff) * (2.0 * now_->f.phi + square(now_->size)); }

  bool last_step() const {
    constexpr double kLastStep = 1e-8;  // Newton converges quadratically: after such a step it is there
    for (int i = 0; i < 2; ++i) {
      const double step = std::abs(step_[i]);
      if (step > kLastStep * conditioning_ &&
          square(step * conditioning_) * now_->f.metric[2 * i] > round_off2())
        return false;
    }
    return true;
  }

  // Backtracking; false if no length of the step leads downhill.
  bool advance() {
    const double slope = now_->f.gradient[0] * step_[0] + now_->f.gradient[1] * step_[1];
    for (double length = 1.0; length > 1e-12; length *= 0.5) {
      move(length, next_->at);
      sample(*next_);
      const double excess = next_->f.phi - (now_->f.phi + kDecrease * length * slope);
      if (excess <= 0.0 || excess < phi_round_off()) {
        std::swap(now_, next_);
        return true;
      }
    }
    return false;
  }
  double phi_round_off() const { return std::sqrt(2.0 * now_->f.phi * round_off2()); }

  // The current point plus part of the step; exactly on a border where it ends there.
  void move(double length, LocalPoint& to) const {
    for (int i = 0; i < 2; ++i) {
      to.e[i] = now_->at.e[i];
      to.s[i] = now_->at.s[i] + length * step_[i];
      if (box_ == nullptr && std::abs(to.s[i]) < kWellInside) continue;
      const double ulp = 4.0 * kEpsilon * (1.0 + std::abs(step_[i]));
      if (to.s[i] <= low(i) + ulp) to.s[i] = low(i);
      if (to.s[i] >= high(i) - ulp) to.s[i] = high(i);
      if (box_ == nullptr && std::abs(to.s[i]) > 1.0) walk(i, to);
    }
  }

  // Expresses a coordinate beyond its element in the element where it lies.
  void walk(int i, LocalPoint& to) const {
    double& s = to.s[i];
    int& e = to.e[i];
    const int side = s > 0.0 ? 1 : -1;
    const double length = std::abs(s);
    while (side * s > 1.0) {
      const AxisElement &here = elements_.axis(i, e), &next = elements_.axis(i, e + side);
      s = side * ((side * s - 1.0) * here.half_width / next.half_width - 1.0);
      e += side;
      const double end = side > 0 ? next.high : next.low;
      if (side * end == 1.0 &&
          side * s > 1.0 - 1e-14 * length * std::max(1.0, here.half_width / next.half_width))
        s = end;
    }
  }

  // Whether the step is as short as it is because a crease is there, over which it may go on.
  bool ends_on_crease() const {
    for (int i = 0; i < 2; ++i) {
      const double s = now_->at.s[i];
      const AxisElement& here = elements_.axis(i, now_->at.e[i]);
      if (held_[i]) continue;
      if (s < 1.0 && here.high == 1.0 && !here.at_end[1] && step_[i] >= here.high - s) return true;
      if (s > -1.0 && here.low == -1.0 && !here.at_end[0] && step_[i] <= here.low - s) return true;
    }
    return false;
  }

  // Held on a crease: goes on in the neighbouring region if that leads downhill.
  bool cross_crease() {
    for (int i = 0; i < 2; ++i) {
      if (!on_crease(i)) continue;
      const int side = now_->at.s[i] > 0.0 ? 1 : -1;
      next_->at = now_->at;
      next_->at.e[i] += side;
      next_->at.s[i] = -side;
      sample(*next_);
      const double slope = -side * next_->f.gradient[i];
      if (!(slope > 0.0 && square(slope) > 16.0 * round_off2() * next_->f.metric[2 * i])) continue;
      std::swap(now_, next_);
      return true;
    }
    return false;
  }
  bool on_crease(int i) const {
    return held_[i] && box_ == nullptr && std::abs(now_->at.s[i]) == 1.0 &&
           !elements_.axis(i, now_->at.e[i]).at_end[now_->at.s[i] > 0.0];
  }
  bool kink(int i) const {
    constexpr double kFlush = 1e-10;  // relative: below it the two sides are one smooth surface
    return on_crease(i) && square(now_->f.gradient[i]) > square(kFlush) * now_->f.metric[2 * i] *
                                                             (2.0 * now_->f.phi + square(now_->size));
  }

  // Of a point that no step leaves.
  DescentEnd classify() const {
    constexpr double kFirm = 1e-9;        // relative, of a slope
    constexpr double kSaddle = -1e-7;     // of phi, where a plane has 1
    constexpr double kBesidePole = 1e-6;  // of the element's size: the length of a tangent
    constexpr double kOnPole = 1e-13;     // the same: derivatives by s tell nothing
    const double(&H)[3] = now_->f.hessian, (&A)[3] = now_->f.metric;
    const double shortest2 = std::min(A[0], A[2]), size2 = square(now_->size);
    const double beside_pole2 = square(kBesidePole) * size2;
    if (convex_ && !held_[0] && !held_[1] && shortest2 > beside_pole2) return DescentEnd::minimum;
    if (shortest2 <= square(kOnPole) * size2) return DescentEnd::unknown;
    // A border pushed against with a weak slope does not hold what is no minimum without it.
    bool free[2];
    for (int i = 0; i < 2; ++i) {
      const double weak2 = square(kFirm) * (2.0 * now_->f.phi + size2) * A[2 * i];
      free[i] = !held_[i] || (box_ == nullptr && square(now_->f.gradient[i]) < weak2);
    }
    if (shortest2 > beside_pole2 && convex_on(free)) return DescentEnd::minimum;
    for (int i = 0; i < 2; ++i) free[i] = free[i] && A[2 * i] > beside_pole2;
    const double a = free[0] ? H[0] / A[0] : 1.0, c = free[1] ? H[2] / A[2] : 1.0,
                 b = free[0] && free[1] ? H[1] / std::sqrt(A[0] * A[2]) : 0.0;
    const double least = 0.5 * (a + c) - std::hypot(0.5 * (a - c), b);
    return least < kSaddle ? DescentEnd::unknown : DescentEnd::degenerate;
  }

  // Takes the last step, too short for S to need more than its tangents, but beside a pole.
  Vector3 finish() {
    constexpr double kShort = 1e-8;
    if (std::max(std::abs(step_[0]), std::abs(step_[1])) > kShort) {
      move(1.0, next_->at);
      sample(*next_);
      if (next_->f.phi <= now_->f.phi + phi_round_off()) std::swap(now_, next_);
      return Vector3(now_->f.r);
    }
    Vector3 r(now_->f.r);
    for (int i = 0; i < 2; ++i) r += step_[i] * Vector3(now_->f.S_i[i]);
    next_->f = now_->f, next_->size = now_->size;
    move(1.0, next_->at);
    std::swap(now_, next_);
    return r;
  }

  const ElementStore& elements_;
  const double d_[3];
  const LocalBox* box_;
  State states_[2];
  State *now_ = &states_[0], *next_ = &states_[1];
  // Of the current point, by propose():
  bool held_[2], convex_;
  double step_[2];
  double conditioning_;  // curvature of phi where a plane has 1, at most 1
};

}  // namespace

namespace {

// Rows that stay in a second-level cache.
bool is_cached(int rows, int lines_per_row) {
  constexpr int kLines = 8192;  // half a megabyte
  return rows <= kLines / lines_per_row;
}

}  // namespace

ElementStore::ElementStore(const Space<2>& space, const PatchPoints& control_points, SimdLevel level)
    : space_(space),
      axes_{{space, 0}, {space, 1}},
      kernel_(element_kernel(space.degree(0), space.degree(1), space.rational(), level)),
      rational_(space.rational()),
      functions_(space.functions_per_element()),
      lines_per_row_((row_length(functions_, rational_) + 7) / 8),
      lines_to_fetch_(is_cached(space.element_count(), lines_per_row_) ? 0 : lines_per_row_),
      control_points_(control_points),
      built_(space.element_count(), 0),
      lines_(new Line[static_cast<size_t>(space.element_count()) * lines_per_row_]) {}

void ElementStore::locate(NewtonBatch& batch) const {
  for (int i = 0; i < 2; ++i) batch.axes[i] = &axes_[i].numbers();
  kernel_.locate(batch);
  for (int k = 0; k < batch.count; ++k) {
    if (batch.element[k] < 0) locate(batch, k);
    const int index = batch.element[k];
    if (built_[index] != version_) build(index % count(0), index / count(0), index);
    const Element element{row(index)};
    prefetch(element);
    batch.row[k] = element.row;
  }
}

// Where elements are not equal.
void ElementStore::locate(NewtonBatch& batch, int k) const {
  batch.element[k] = 0;
  for (int i = 0; i < 2; ++i) {
    const ElementAxis::Place place = axes_[i].locate(batch.xi[i][k]);
    const AxisElement& element = axes_[i][place.e];
    batch.element[k] += (i == 0 ? 1 : count(0)) * place.e;
    batch.s[i][k] = place.s;
    batch.begin[i][k] = element.begin, batch.end[i][k] = element.end;
    batch.half_width[i][k] = element.half_width;
  }
}

void ElementStore::homogeneous_points(const int (&e)[2], Vector4* out) const {
  static const Eigen::Matrix<double, kMaxDegree + 1, kMaxDegree + 1, Eigen::RowMajor> identity =
      Eigen::MatrixXd::Identity(kMaxDegree + 1, kMaxDegree + 1);
  const auto* I = reinterpret_cast<const ElementKernel::Matrix*>(identity.data());
  kernel_.transform(kernel_.p, kernel_.q, I, I, net(e[0], e[1]), out->data());
}

void ElementStore::build(int e0, int e1, int index) const {
  NURBS_ASSERT(0 <= e0 && e0 < count(0) && 0 <= e1 && e1 < count(1), e0, e1, count(0), count(1));
  kernel_.build(kernel_.p, kernel_.q, axis(0, e0).functions->power, axis(1, e1).functions->power, net(e0, e1),
                row(index));
  built_[index] = version_;
}

DescentResult descend(const ElementStore& elements, const Vector3& d, const LocalPoint& start,
                      const LocalBox* box) {
  return Descent(elements, d, start, box).run();
}

}  // namespace search

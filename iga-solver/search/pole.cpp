// SPDX-License-Identifier: GPL-2.0-or-later
#include "search/pole.h"

#include <algorithm>
#include <cmath>

namespace search {
namespace {

constexpr double kBeside = 1e-5;    // of an element
constexpr double kOnePoint = 1e-9;  // of an element's size: an edge shorter than that is a pole
constexpr double kFlat = 3e-8;      // a slope, relative, that counts as none
constexpr int kPlaces = 16;         // parts of an element, where curvatures are looked at
constexpr double kShortest = 1e-4;  // of an element: below it a slope that may be negative is

// Of the kinds of two parts of a pole that of the whole: a slope outweighs all.
PoleKind worse(PoleKind a, PoleKind b) {
  if (a == PoleKind::none || b == PoleKind::none) return PoleKind::none;
  if (a == PoleKind::slope || b == PoleKind::slope) return PoleKind::slope;
  return std::max(a, b);
}

// The ways from one element's part of a pole into the patch.  With the pole P as origin, the slope of phi
// into direction j is, up to a positive factor, sum_k B_k(s_i) b_k, b_k = r.(A_k - W_k P), r = P - d: A_k and
// W_k are the homogeneous Bezier points next to the pole.
class PoleElement {
 public:
  PoleElement(const ElementStore& elements, const Vector3& d, const int (&e)[2], int j, bool upper)
      : elements_(elements), e_{e[0], e[1]}, j_(j), upper_(upper), d_{d[0], d[1], d[2]} {
    const ElementKernel& kernel = elements.kernel();
    const int n[2] = {kernel.p, kernel.q}, stride[2] = {1, kernel.p + 1}, i = 1 - j;
    Vector4 points[power(kMaxDegree + 1, 2)];
    elements.homogeneous_points(e, points);
    const auto weight = [&](const Vector4& A) { return elements.rational() ? A[3] : 1.0; };
    const int edge = upper ? n[j] * stride[j] : 0, next = upper ? edge - stride[j] : stride[j];
    const Vector4 pole = points[edge] / weight(points[edge]);
    r_ = pole.head<3>().matrix() - (d - elements.element(e).origin().head<3>().matrix());

    const double size = elements.element(e).size();
    one_point_ = true;
    double slopes[kMaxDegree + 1], longest = 0.0;
    for (int k = 0; k <= n[i]; ++k) {
      const Vector4 &A = points[edge + k * stride[i]], &B = points[next + k * stride[i]];
      const Vector4 along = A / weight(A) - pole, inward = B - weight(B) * pole;
      one_point_ = one_point_ && along.head<3>().matrix().norm() <= kOnePoint * size;
      slopes[k] = r_.dot(inward.head<3>().matrix());
      longest = std::max(longest, inward.head<3>().matrix().norm());
    }
    scale_ = r_.norm() * longest;
    flat_ = kFlat * scale_;
    for (int k = 0; k <= n[i]; ++k) {
      b_[k] = 0.0;
      for (int m = 0; m <= n[i]; ++m) b_[k] += elements.axis(i, e[i]).functions->bezier[k][m] * slopes[m];
    }
    n_ = n[i];
  }

  const Vector3& r() const { return r_; }
  PoleKind kind() { return one_point_ ? kind(b_, -1.0, 1.0) : PoleKind::none; }
  /// Least slope seen by kind(), relative, and where.
  double steepest() const { return steepest_; }
  LocalPoint downhill() const {
    constexpr double kFarthest = 0.5;
    const DistanceJet jet = sample(place_);
    const double slope = std::abs(jet.gradient[j_]), bend = jet.hessian[2 * j_];
    LocalPoint at{{e_[0], e_[1]}, {place_, place_}};
    at.s[j_] =
        (upper_ ? -1.0 : 1.0) * (slope < kFarthest * bend ? slope / bend : kFarthest) + (upper_ ? 1.0 : -1.0);
    return at;
  }

 private:
  // On the part low <= s_i <= high, where the slope has the Bernstein coefficients b.
  PoleKind kind(const double (&b)[kMaxDegree + 1], double low, double high) {
    const double least = *std::min_element(b, b + n_ + 1);
    if (least > flat_) return PoleKind::minimum;
    const double end = std::min(b[0], b[n_]);
    if (end < -flat_) {
      if (end / scale_ < steepest_) steepest_ = end / scale_, place_ = b[0] < b[n_] ? low : high;
      return PoleKind::slope;
    }
    if (high - low <= 2.0 / kPlaces && least >= -flat_)
      return bends_down(low, high) ? PoleKind::saddle : PoleKind::minimum;
    if (high - low < kShortest) return PoleKind::slope;
    double lower[kMaxDegree + 1], upper[kMaxDegree + 1] = {};
    std::copy_n(b, n_ + 1, upper);
    for (int k = 0; k <= n_; ++k) {  // de Casteljau
      lower[k] = upper[0];
      for (int m = 0; m < n_ - k; ++m) upper[m] = 0.5 * (upper[m] + upper[m + 1]);
    }
    const double middle = 0.5 * (low + high);
    return worse(kind(lower, low, middle), kind(upper, middle, high));
  }

  // Whether phi curves down on a way into the patch from anywhere between two places: there it may differ
  // from what it is on three by their second difference, so that is made small.
  bool bends_down(double low, double high) const {
    const double middle = 0.5 * (low + high);
    const double a = bend(low), b = bend(middle), c = bend(high), least = std::min({a, b, c});
    if (!(least > 0.0)) return true;
    if (least > std::abs(a - 2.0 * b + c) || high - low < kShortest) return false;
    return bends_down(low, middle) || bends_down(middle, high);
  }
  double bend(double s) const {
    const DistanceJet jet = sample(s);
    return jet.hessian[2 * j_] - kLeastCurvature * jet.metric[2 * j_];
  }

  DistanceJet sample(double s) const {
    double at[2];
    at[j_] = upper_ ? 1.0 : -1.0;
    at[1 - j_] = s;
    const ElementKernel& kernel = elements_.kernel();
    DistanceJet jet;
    kernel.evaluate(kernel.p, kernel.q, elements_.element(e_).row, at, d_, jet);
    return jet;
  }

  const ElementStore& elements_;
  int e_[2], j_;
  bool upper_, one_point_;
  double d_[3];
  Vector3 r_;
  int n_;
  double b_[kMaxDegree + 1], scale_, flat_;
  double steepest_ = 0.0, place_ = 0.0;
};

}  // namespace

Pole pole_beside(const ElementStore& elements, const Vector3& d, const LocalPoint& near) {
  for (int j = 0; j < 2; ++j) {
    const bool upper = near.s[j] > 0.0;
    if (std::abs(near.s[j]) < 1.0 - kBeside || !elements.axis(j, near.e[j]).at_end[upper]) continue;
    Pole pole{PoleKind::minimum, near, {}};
    pole.at.s[j] = upper ? 1.0 : -1.0;
    double steepest = 0.0;
    int e[2] = {near.e[0], near.e[1]};
    for (e[1 - j] = 0; pole.kind != PoleKind::none && e[1 - j] < elements.count(1 - j); ++e[1 - j]) {
      PoleElement element(elements, d, e, j, upper);
      pole.kind = worse(pole.kind, element.kind());
      pole.r = element.r();
      if (!(element.steepest() < steepest)) continue;
      steepest = element.steepest();
      pole.at = element.downhill();
    }
    if (pole.kind != PoleKind::none) return pole;
  }
  return {PoleKind::none, near, {}};
}

}  // namespace search

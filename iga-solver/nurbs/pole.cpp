// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/pole.h"

#include <algorithm>
#include <cmath>

namespace nurbs {
namespace {

constexpr double kOnePoint = 1e-9;         // of an element's size: an edge shorter than that is a pole
constexpr double kFlat = 1e-10;            // a slope, relative, that counts as none
constexpr int kPlaces = 16;                // per element, where curvatures are looked at
constexpr double kShortest = 1e-4;         // of an element: below it a slope that may be negative is
constexpr double kLeastCurvature = 1e-10;  // of phi, where a plane has 1

// The ways from one element's part of a pole into the patch.  With the pole P as origin, the slope of phi
// into direction j is, up to a positive factor, sum_k B_k(s_i) b_k, b_k = r.(A_k - W_k P), r = P - d: A_k and
// W_k are the homogeneous Bezier points next to the pole.
class PoleElement {
 public:
  PoleElement(const ElementStore& elements, const Vector3& d, const int (&e)[2], int j, bool upper)
      : elements_(elements), e_{e[0], e[1]}, j_(j), upper_(upper) {
    const ElementKernel& kernel = elements.kernel();
    const int n[2] = {kernel.p, kernel.q}, stride[2] = {1, kernel.p + 1}, i = 1 - j;
    Vector4 points[power(kMaxDegree + 1, 2)];
    const Vector4 origin = elements.homogeneous_points(e, points);
    const auto weight = [&](const Vector4& A) { return elements.rational() ? A[3] : 1.0; };
    const int edge = upper ? n[j] * stride[j] : 0, next = upper ? edge - stride[j] : stride[j];
    const Vector4 pole = points[edge] / weight(points[edge]);
    d_ = Vector4(d[0], d[1], d[2], elements.rational() ? 1.0 : 0.0) - origin;
    const Eigen::Vector3d r = (pole - d_).head<3>().matrix();

    const double size = elements.element(e).size;
    one_point_ = true;
    double slopes[kMaxDegree + 1], longest = 0.0;
    for (int k = 0; k <= n[i]; ++k) {
      const Vector4 &A = points[edge + k * stride[i]], &B = points[next + k * stride[i]];
      const Vector4 along = A / weight(A) - pole, inward = B - weight(B) * pole;
      one_point_ = one_point_ && along.head<3>().matrix().norm() <= kOnePoint * size;
      slopes[k] = r.dot(inward.head<3>().matrix());
      longest = std::max(longest, inward.head<3>().matrix().norm());
    }
    flat_ = kFlat * r.norm() * longest;
    for (int k = 0; k <= n[i]; ++k) {
      b_[k] = 0.0;
      for (int m = 0; m <= n[i]; ++m) b_[k] += elements.axis(i, e[i]).bezier[k][m] * slopes[m];
    }
    n_ = n[i];
  }

  bool one_point() const { return one_point_; }
  bool leads_downhill() const { return leads_downhill(b_, -1.0, 1.0); }

 private:
  // On the part low <= s_i <= high, where the slope has the Bernstein coefficients b.
  bool leads_downhill(const double (&b)[kMaxDegree + 1], double low, double high) const {
    const double least = *std::min_element(b, b + n_ + 1);
    if (least > flat_) return false;
    if (std::min(b[0], b[n_]) < -flat_) return true;
    if (high - low <= 2.0 / kPlaces && least >= -flat_) return bends_down(low) || bends_down(high);
    if (high - low < kShortest) return true;
    double lower[kMaxDegree + 1], upper[kMaxDegree + 1];
    std::copy_n(b, n_ + 1, upper);
    for (int k = 0; k <= n_; ++k) {  // de Casteljau
      lower[k] = upper[0];
      for (int m = 0; m < n_ - k; ++m) upper[m] = 0.5 * (upper[m] + upper[m + 1]);
    }
    const double middle = 0.5 * (low + high);
    return leads_downhill(lower, low, middle) || leads_downhill(upper, middle, high);
  }

  bool bends_down(double s) const {
    double at[2];
    at[j_] = upper_ ? 1.0 : -1.0;
    at[1 - j_] = s;
    const ElementKernel& kernel = elements_.kernel();
    DistanceJet jet;
    kernel.evaluate(kernel.p, kernel.q, elements_.element(e_).a, at, d_, jet);
    return !(jet.hessian[2 * j_] > kLeastCurvature * jet.metric[2 * j_]);
  }

  const ElementStore& elements_;
  int e_[2], j_;
  bool upper_, one_point_;
  Vector4 d_;  // relative to the element's origin
  int n_;
  double b_[kMaxDegree + 1], flat_;
};

}  // namespace

bool minimum_on_pole(const ElementStore& elements, const Vector3& d, const LocalPoint& at) {
  for (int j = 0; j < 2; ++j) {
    const bool upper = at.s[j] > 0.0;
    if (std::abs(at.s[j]) != 1.0 || !elements.axis(j, at.e[j]).at_end[upper]) continue;
    int e[2] = {at.e[0], at.e[1]};
    bool minimum = true;
    for (e[1 - j] = 0; minimum && e[1 - j] < elements.count(1 - j); ++e[1 - j]) {
      const PoleElement element(elements, d, e, j, upper);
      minimum = element.one_point() && !element.leads_downhill();
    }
    if (minimum) return true;
  }
  return false;
}

}  // namespace nurbs

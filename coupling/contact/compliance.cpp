// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/compliance.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

namespace contact {

// With c > 0 the left side is concave and Newton's steps come up from below; with c < 0 it is convex, and
// they come down from above.
CorrectedOverlap corrected_overlap(double overlap, double c, double K, double limit) {
  constexpr int kMostSteps = 60;
  constexpr double kSame = 1e-14;
  CorrectedOverlap at{overlap, 0.0};
  for (int step = 0; step < kMostSteps; ++step) {
    const double cK_root = c * K * std::sqrt(at.x);
    at.s = 1.5 * cK_root;
    if (at.s >= limit) return at;
    const double change = (overlap - at.x * (1.0 - cK_root)) / (1.0 - at.s);
    at.x += change;
    if (std::abs(change) <= kSame * at.x) break;
  }
  return at;
}

namespace {

[[noreturn]] void fail_as_too_fine(const ParticleView& particles, long step, const Contact& contact,
                                   double s) {
  constexpr double kSafe = 0.6;
  const int i = contact.particle;
  const Vector3 foot = particles.centre(i) - contact.delta;
  throw std::runtime_error(fmt::format(
      "elements at ({:.6g}, {:.6g}, {:.6g}) are too small for the contact of particle {} at step {}: what "
      "they give way is {:.2g} of what its law does, expected at most {:.2g}; use elements at least {:.2g} "
      "times as large there, or 'compliance none'",
      foot[0], foot[1], foot[2], particles.tag[i], step, s, ComplianceCorrection::kLargest, s / kSafe));
}

}  // namespace

namespace {

using Tangents = Eigen::Matrix<double, 3, 2>;

/// Functions of one direction at xi, and their derivatives, from their powers on the element.
struct DirectionValues {
  DirectionValues(const nurbs::Space<2>& space, int d, double xi) {
    const nurbs::KnotVector& knots = space.knots(d);
    const int element = knots.element_at(xi);
    const double low = knots.breaks()[element], high = knots.breaks()[element + 1],
                 scale = 2.0 / (high - low);
    const double s = scale * (xi - low) - 1.0;
    const nurbs::ElementFunctions& functions = space.functions(d, element);
    count = knots.degree() + 1;
    first = knots.span_of_element(element) - knots.degree();
    for (int j = 0; j < count; ++j) {
      N[j] = dN[j] = 0.0;
      for (int k = count - 1; k >= 0; --k) {
        dN[j] = dN[j] * s + N[j];
        N[j] = N[j] * s + functions.power[k][j];
      }
      dN[j] *= scale;
    }
  }
  int first, count;
  double N[nurbs::kMaxDegree + 1], dN[nurbs::kMaxDegree + 1];
};

/// dS/dxi and dS/deta of a patch whose control points are columns of X from `first` on: of S = A/W those are
/// (dA - S dW)/W.
template <bool rational>
Tangents tangents_at(const nurbs::Space<2>& space, const nurbs::Parameter<2>& xi,
                     const nurbs::NodalVectors& X, int first) {
  const DirectionValues u(space, 0, xi[0]), v(space, 1, xi[1]);
  Tangents dA = Tangents::Zero();
  Vector3 A = Vector3::Zero();
  double W = 0.0, dW[2] = {0.0, 0.0};
  for (int j = 0; j < v.count; ++j) {
    const int begin = u.first + space.control_point_count(0) * (v.first + j);
    Vector3 along = Vector3::Zero(), value = Vector3::Zero();
    double w_along = 0.0, w_value = 0.0;
    for (int i = 0; i < u.count; ++i) {
      const double w = rational ? space.weights()[begin + i] : 1.0, N = w * u.N[i], dN = w * u.dN[i];
      along += dN * X.col(first + begin + i);
      value += N * X.col(first + begin + i);
      if constexpr (rational) w_along += dN, w_value += N;
    }
    dA.col(0) += v.N[j] * along;
    dA.col(1) += v.dN[j] * value;
    if constexpr (!rational) continue;
    A += v.N[j] * value;
    W += v.N[j] * w_value;
    dW[0] += v.N[j] * w_along;
    dW[1] += v.dN[j] * w_value;
  }
  if constexpr (rational)
    for (int d = 0; d < 2; ++d) dA.col(d) = (dA.col(d) - dW[d] / W * A) / W;
  return dA;
}

}  // namespace

/// Of c along the surface as it now is.
Vector3 ComplianceCorrection::gradient(const Contact& contact, const std::array<double, 2>& change) const {
  const nurbs::MultiPatch& surface = wall_.surface();
  const int patch = contact.foot.patch;
  const nurbs::Space<2>& space = surface.patch(patch);
  const auto at = space.rational() ? &tangents_at<true> : &tangents_at<false>;
  const Tangents tangents =
      at(space, contact.foot.xi, wall_.control_points(), surface.first_control_point(patch));
  const Eigen::Matrix2d metric = tangents.transpose() * tangents;
  const Eigen::Vector2d along = metric.inverse() * Eigen::Vector2d(change[0], change[1]);
  return wall_.to_space_direction(tangents * along);
}

void ComplianceCorrection::correct(const ParticleView& particles, long step, double K, Contact& contact,
                                   Before& before) {
  const coupling::LocalCompliance::Value c = compliance_.at(contact.foot);
  const auto [x, s] = corrected_overlap(contact.overlap, c.normal, K, kLargest);
  if (s >= kLargest) fail_as_too_fine(particles, step, contact, s);
  const double F = K * x * std::sqrt(x), tangent = 1.5 * K * std::sqrt(x) / (1.0 - s);
  before.along = -0.5 * F * F * gradient(contact, c.change);
  before.tangent = tangent;
  // dx/dt = d(overlap)/dt / (1 - s), for what depends on it
  const Vector3 n = contact.delta / contact.distance;
  const double approach = n.dot(contact.wall_velocity - particles.velocity(contact.particle));
  contact.wall_velocity += approach * s / (1.0 - s) * n;
  const double distance = contact.distance + contact.overlap - x;
  contact.delta *= distance / contact.distance;
  contact.distance = distance;
  contact.overlap = x;
}

void ComplianceCorrection::before(const ParticleView& particles, long step, const ContactModel& model,
                                  Contact* begin, Contact* end) {
  before_.clear();
  for (Contact* c = begin; c < end; ++c) {
    Contact& contact = *c;
    Before& before = before_.emplace_back(Before{contact.overlap, contact.distance, contact.delta,
                                                 contact.wall_velocity, Vector3::Zero(), 0.0});
    if (!(contact.overlap > 0.0)) continue;
    const double K = model.hertz_constant(contact.particle) * std::sqrt(contact.effective_radius);
    correct(particles, step, K, contact, before);
  }
}

void ComplianceCorrection::after(Contact* begin, Contact* end) {
  for (Contact* c = begin; c < end; ++c) {
    Contact& contact = *c;
    const Before& before = before_[c - begin];
    contact.overlap = before.overlap;
    contact.distance = before.distance;
    contact.delta = before.delta;
    contact.wall_velocity = before.wall_velocity;
    contact.force += before.along;
    contact.tangent = before.tangent;
  }
}

}  // namespace contact

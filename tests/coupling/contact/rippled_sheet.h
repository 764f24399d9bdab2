// SPDX-License-Identifier: GPL-2.0-or-later
// Balls over a sheet whose mesh gives way, as it says, and that does not move: what they do is the
// correction's own.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "balls.h"
#include "coupling/contact/contact_loop.h"
#include "nurbs/primitives.h"
#include "rising_sheet.h"

namespace ripples {

using nurbs::Vector3;
using test::kRadius;

constexpr double kConstant = 1e4, kSide = 8.0;
inline const double kK = kConstant * std::sqrt(kRadius);

/// c = c0 (1 + ripple sin(2 pi x) cos(2 pi y)), one wave per element of length 1.
class Ripples final : public coupling::LocalCompliance {
 public:
  Ripples(double c0, double ripple) : c0_(c0), ripple_(ripple) {}
  void find(const nurbs::SurfacePoint& foot, const nurbs::Indices<2>& /*element*/, bool /*with_shear*/,
            Value& value) override {
    const double k = nurbs::kTwoPi * kSide, x = k * foot.xi[0], y = k * foot.xi[1];
    value = {
        {c0_ * (1.0 + ripple_ * std::sin(x) * std::cos(y)),
         {c0_ * ripple_ * k * std::cos(x) * std::cos(y), -c0_ * ripple_ * k * std::sin(x) * std::sin(y)}},
        along,
        0.0};
  }
  std::array<Component, 3> along = {};

 private:
  double c0_, ripple_;
};

/// F = K x^(3/2) along delta, damped by `damping` x^(1/4) of what it does not look at here.
class Hertz final : public contact::ContactModel {
 public:
  void evaluate(contact::Contact* contacts, int count) override {
    for (contact::Contact* c = contacts; c < contacts + count; ++c) {
      const double x = std::max(c->overlap, 0.0);
      c->force = kConstant * std::sqrt(c->effective_radius) * x * std::sqrt(x) / c->distance * c->delta;
      c->torque.setZero();
      seen = *c;
    }
  }
  double hertz_constant(int) const override { return kConstant; }
  double hertz_damping(int) const override { return damping; }
  double damping = 0.0;
  contact::Contact seen;
};

/// The plane z = 0 of 8 x 8 elements; or one whose weights draw its parameters together here and there; or a
/// hill or a hollow, of a radius of about eight of the balls', rational, too.
enum class Sheet { plane, rational, hill, hollow };
inline nurbs::Surface sheet_of(Sheet kind) {
  nurbs::Surface sheet = nurbs::plane({-4, -4, 0}, {kSide, 0, 0}, {0, kSide, 0},
                                      {nurbs::KnotVector::uniform(2, 8), nurbs::KnotVector::uniform(2, 8)});
  if (kind == Sheet::plane) return sheet;
  std::vector<double> weights;
  for (int c = 0; c < sheet.space.control_point_count(); ++c) weights.push_back(1.0 + 0.1 * (c * c % 7));
  sheet.space = nurbs::Space<2>(sheet.space.knots(), weights);
  const double bend = kind == Sheet::hill ? -0.125 : kind == Sheet::hollow ? 0.125 : 0.0;
  sheet.control_points.row(2) = bend * sheet.control_points.topRows(2).colwise().squaredNorm();
  return sheet;
}

struct Scene {
  Scene(coupling::LocalCompliance& compliance, const Vector3& centre, const Vector3& velocity, double dt,
        Sheet kind = Sheet::plane)
      : dt(dt), sheet(sheet_of(kind), 0.0), balls(2, contact::ComplianceCorrection::kMemory) {
    sheet.compliance = &compliance;
    sheet.set_time_step(dt);
    balls.add(centre, kRadius, velocity);
  }
  void begin(const nurbs::NodalVectors& inverse_mass = {}) {
    sheet.inverse_mass = inverse_mass;
    exchange.emplace(MPI_COMM_SELF, sheet);
    loop.emplace(sheet, *exchange, contact::ContactLoop::Options{});
    loop->wall().import();
    loop->build_list(balls.view(), {4.0, 1.0, dt, {{-9, -9, -9}, {9, 9, 9}, {false, false, false}}});
    evaluate();
  }
  void evaluate() {
    std::fill(balls.f.begin(), balls.f.end(), 0.0);
    std::fill(balls.torque.begin(), balls.torque.end(), 0.0);
    loop->step(balls.view(), {++step_number, dt, 1.0, false}, model);
  }
  void step() {
    for (std::size_t k = 0; k < balls.x.size(); ++k) balls.x[k] += dt * (balls.v[k] += 0.5 * dt * balls.f[k]);
    evaluate();
    for (std::size_t k = 0; k < balls.v.size(); ++k) balls.v[k] += 0.5 * dt * balls.f[k];
  }
  bool is_over() { return balls.velocity(0)[2] > 0.0 && loop->contacts().empty(); }

  double dt;
  test::RisingSheet sheet;
  test::Balls balls;
  Hertz model;
  std::optional<coupling::SurfaceExchange> exchange;
  std::optional<contact::ContactLoop> loop;
  long step_number = 0;
};

/// Sends the ball back where it is farther than that from the sheet, or from its middle.
inline void keep_above(Scene& scene, double height, double way) {
  const Vector3 x = scene.balls.centre(0);
  auto v = scene.balls.velocity(0);
  if (x[2] > height) v[2] = -std::abs(v[2]);
  for (int d = 0; d < 2; ++d)
    if (std::abs(x[d]) > way) v[d] = -std::copysign(v[d], x[d]);
}

}  // namespace ripples

// SPDX-License-Identifier: GPL-2.0-or-later
// A particle code of its own on our contact: balls on springs in a round bowl.  Exit code 0 if energy holds.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "coupling/contact/contact_loop.h"
#include "coupling/rigid/rigid_surface.h"
#include "nurbs/primitives.h"

using nurbs::Vector3;

struct Spring : contact::ContactModel {
  static constexpr double kStiffness = 1e4;
  double energy = 0.0;
  void evaluate(contact::Contact* contacts, int count) override {
    for (contact::Contact* c = contacts; c < contacts + count; ++c) {
      const double overlap = std::max(c->overlap, 0.0);
      c->force = kStiffness * overlap / c->distance * c->delta;
      c->torque.setZero();
      energy += 0.5 * kStiffness * overlap * overlap;
    }
  }
};

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  constexpr int kBalls = 200, kSteps = 20000, kRelist = 20;
  constexpr double kStep = 1e-4, kSkin = 0.05, kGravity = 9.81;
  coupling::RigidSurface bowl(
      {nurbs::sphere(nurbs::frame({0, 0, 0}, {0, 0, 1}), 1.0, nurbs::arc(0, 360), nurbs::arc(-90, 0))});
  coupling::SurfaceExchange exchange(MPI_COMM_SELF, bowl);
  contact::ContactLoop loop(bowl, exchange, {});
  loop.wall().import();

  std::vector<double> x, v(3 * kBalls), f(3 * kBalls), torque(3 * kBalls), radius(kBalls, 0.05);
  std::vector<double> slots;
  std::vector<int> tag;
  for (int i = 0; i < kBalls; ++i) {
    const double turn = 2.4 * i, off = 0.8 * std::sqrt((i + 0.5) / kBalls);
    x.insert(x.end(), {off * std::cos(turn), off * std::sin(turn), -0.2});
    slots.insert(slots.end(), {contact::ContactSlot::kEmpty, 0.0, 0.0});
    tag.push_back(i + 1);
  }
  double* const slot[] = {slots.data()};
  const contact::ParticleView balls{kBalls,   tag.data(),    radius.data(), x.data(), v.data(),
                                    f.data(), torque.data(), nullptr,       0,        {slot, 1, 0}};
  Spring spring;
  const auto energy = [&] {  // mass 1 each
    double sum = spring.energy;
    for (int i = 0; i < kBalls; ++i)
      sum += 0.5 * balls.velocity(i).squaredNorm() + kGravity * (balls.centre(i)[2] + 1.0);
    return sum;
  };
  double first = 0.0;
  for (int step = 0; step <= kSteps; ++step) {
    for (int k = 0; k < 3 * kBalls && step > 0; ++k) x[k] += kStep * (v[k] += 0.5 * kStep * f[k]);
    if (step % kRelist == 0) loop.build_list(balls, {kSkin, 1.0, kStep, {}});
    std::fill(torque.begin(), torque.end(), 0.0);
    for (int k = 0; k < 3 * kBalls; ++k) f[k] = k % 3 == 2 ? -kGravity : 0.0;
    spring.energy = 0.0;
    loop.step(balls, {step, kStep, 1.0, step == 0}, spring);
    for (int k = 0; k < 3 * kBalls && step > 0; ++k) v[k] += 0.5 * kStep * f[k];
    if (step == 0) first = energy();
  }
  std::printf("energy %.9g, at first %.9g, %zu contacts\n", energy(), first, loop.contacts().size());
  MPI_Finalize();
  return std::abs(energy() / first - 1.0) < 1e-4 ? 0 : 1;
}

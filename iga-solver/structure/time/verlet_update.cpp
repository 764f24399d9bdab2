// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/time/verlet_update.h"

#include <type_traits>

namespace structure {

namespace {

/// Numbers at a time: as many partial sums, which the compiler may keep in vectors without reordering any.
constexpr int kLanes = 4;
using Lanes = Eigen::Array<double, kLanes, 1>;

template <int n>
auto part(const NodalVectors& values, Eigen::Index first) {
  return Eigen::Map<const Eigen::Array<double, n, 1>>(values.data() + first);
}

template <int n>
auto part(NodalVectors& values, Eigen::Index first) {
  return Eigen::Map<Eigen::Array<double, n, 1>>(values.data() + first);
}

/// visit(n, i) for the n numbers from i on: kLanes, and the rest one by one.
template <class Visit>
void for_each_part(Eigen::Index first, Eigen::Index end, Visit visit) {
  Eigen::Index i = first;
  for (; i + kLanes <= end; i += kLanes) visit(std::integral_constant<int, kLanes>(), i);
  for (; i < end; ++i) visit(std::integral_constant<int, 1>(), i);
}

}  // namespace

double kick_and_drift(double dt, const NodalVectors& a, const NodalVectors& reference, NodalVectors& v,
                      NodalVectors& u, NodalVectors& x) {
  const double h = 0.5 * dt;
  Lanes largest = Lanes::Zero();
  for_each_part(0, u.size(), [&](auto width, Eigen::Index i) {
    constexpr int n = width;
    const Eigen::Array<double, n, 1> v_half = part<n>(v, i) + h * part<n>(a, i);
    const Eigen::Array<double, n, 1> u_next = part<n>(u, i) + dt * v_half;
    part<n>(v, i) = v_half;
    part<n>(u, i) = u_next;
    part<n>(x, i) = part<n>(reference, i) + u_next;
    largest.head<n>() = largest.head<n>().max(u_next.abs());
  });
  return largest.maxCoeff();
}

ForceSums accelerate_and_kick(double h, const NodalForces& f, const NodalVectors& inverse_mass,
                              Eigen::Index first, Eigen::Index count, NodalVectors& a, NodalVectors& v) {
  constexpr int kSummed = kSupports;  // supports do no work here
  Lanes f_v[kSummed], f_a[kSummed];
  for (int k = 0; k < kSummed; ++k) f_v[k] = f_a[k] = Lanes::Zero();
  for_each_part(3 * first, 3 * (first + count), [&](auto width, Eigen::Index i) {
    constexpr int n = width;
    using Part = Eigen::Array<double, n, 1>;
    const Part internal = part<n>(f.internal, i), loads = part<n>(f.loads, i), forces = part<n>(f.forces, i);
    const Part acceleration = (loads + forces - internal) * part<n>(inverse_mass, i);
    const Part velocity = part<n>(v, i) + h * acceleration;
    part<n>(a, i) = acceleration;
    part<n>(v, i) = velocity;
    f_v[kInternal].head<n>() += internal * velocity;
    f_a[kInternal].head<n>() += internal * acceleration;
    f_v[kLoads].head<n>() += loads * velocity;
    f_a[kLoads].head<n>() += loads * acceleration;
    f_v[kForces].head<n>() += forces * velocity;
    f_a[kForces].head<n>() += forces * acceleration;
  });
  ForceSums sums;
  for (int k = 0; k < kSummed; ++k) {
    sums.f_v[k] = f_v[k].sum();
    sums.f_a[k] = f_a[k].sum();
  }
  return sums;
}

}  // namespace structure

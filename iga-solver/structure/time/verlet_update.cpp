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

namespace {

/// Kinds of forces whose sums a pass takes; supports do no work there.
constexpr int kSummed[] = {kInternal, kLoads, kForces, kDamping};

/// What a pass over the nodes sums.
struct LaneSums {
  Lanes f_v[kForceKinds], f_a[kForceKinds];
  LaneSums() {
    for (const int k : kSummed) f_v[k] = f_a[k] = Lanes::Zero();
  }
  template <int n, class Part>
  void add(int k, const Part& f, const Part& velocity, const Part& acceleration) {
    f_v[k].template head<n>() += f * velocity;
    f_a[k].template head<n>() += f * acceleration;
  }
  /// Of the n numbers from i on.
  template <int n, class Part>
  void add(const NodalForces& f, Eigen::Index i, const Part& velocity, const Part& acceleration) {
    add<n, Part>(kInternal, part<n>(f.internal, i), velocity, acceleration);
    add<n, Part>(kLoads, part<n>(f.loads, i), velocity, acceleration);
    add<n, Part>(kForces, part<n>(f.forces, i), velocity, acceleration);
  }
  ForceSums total() const {
    ForceSums sums;
    for (const int k : kSummed) {
      sums.f_v[k] = f_v[k].sum();
      sums.f_a[k] = f_a[k].sum();
    }
    return sums;
  }
};

template <bool is_damped>
ForceSums accelerate_and_kick(double h, const NodalForces& f, const NodalVectors& inverse_mass,
                              Eigen::Index first, Eigen::Index count, NodalVectors& a, NodalVectors& v,
                              double damping) {
  LaneSums sums;
  for_each_part(3 * first, 3 * (first + count), [&](auto width, Eigen::Index i) {
    constexpr int n = width;
    using Part = Eigen::Array<double, n, 1>;
    const Part inverse = part<n>(inverse_mass, i);
    Part acceleration = (part<n>(f.loads, i) + part<n>(f.forces, i) - part<n>(f.internal, i)) * inverse,
         velocity = part<n>(v, i);
    if constexpr (is_damped) {
      const Part none = Part::Zero(), rate = (inverse > 0.0).select(Part::Constant(damping), none);
      velocity += h * ((acceleration - rate * velocity) / (1.0 + h * rate));
      acceleration -= rate * velocity;  // as a run that begins here finds it
      const Part force = (inverse > 0.0).select(-rate * velocity / inverse, none);
      sums.add<n>(kDamping, force, velocity, acceleration);
    } else {
      velocity += h * acceleration;
    }
    part<n>(a, i) = acceleration;
    part<n>(v, i) = velocity;
    sums.add<n>(f, i, velocity, acceleration);
  });
  return sums.total();
}

}  // namespace

ForceSums accelerate_and_kick(double h, const NodalForces& f, const NodalVectors& inverse_mass,
                              Eigen::Index first, Eigen::Index count, NodalVectors& a, NodalVectors& v,
                              double damping) {
  return damping > 0.0 ? accelerate_and_kick<true>(h, f, inverse_mass, first, count, a, v, damping)
                       : accelerate_and_kick<false>(h, f, inverse_mass, first, count, a, v, damping);
}

ForceSums kick(double h, const NodalForces& f, Eigen::Index first, Eigen::Index count, const NodalVectors& a,
               NodalVectors& v) {
  LaneSums sums;
  for_each_part(3 * first, 3 * (first + count), [&](auto width, Eigen::Index i) {
    constexpr int n = width;
    const Eigen::Array<double, n, 1> acceleration = part<n>(a, i),
                                     velocity = part<n>(v, i) + h * acceleration;
    part<n>(v, i) = velocity;
    sums.add<n>(f, i, velocity, acceleration);
    if (!f.damping) return;
    const Eigen::Array<double, n, 1> damping = part<n>(*f.damping, i);
    sums.add<n>(kDamping, damping, velocity, acceleration);
  });
  return sums.total();
}

}  // namespace structure

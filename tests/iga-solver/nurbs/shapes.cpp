// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/shapes.h"

#include <cmath>

namespace nurbs::shapes {

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vector3 point_near_square(Random& random) {
  return {uniform(random, -0.3, 1.3), uniform(random, -0.3, 1.3), uniform(random, -0.6, 0.6)};
}

Profile line(double rho, double height) {
  return {KnotVector::uniform(1, 1), {rho, rho}, {0.0, height}, {1.0, 1.0}};
}

Profile quarter_arc(double centre, double radius) {
  return {KnotVector::uniform(2, 1),
          {centre + radius, centre + radius, centre},
          {0.0, radius, radius},
          {1.0, std::sqrt(0.5), 1.0}};
}

Surface revolve(const Profile& profile, double arc_angle, int arcs) {
  std::vector<double> knots{0.0};
  for (int arc = 0; arc <= arcs; ++arc) knots.insert(knots.end(), 2, arc);
  knots.push_back(arcs);

  const int n_azimuth = 2 * arcs + 1, n_profile = profile.knots.control_point_count();
  NodalVectors control_points(3, n_azimuth * n_profile);
  std::vector<double> weights;
  for (int j = 0; j < n_profile; ++j)
    for (int i = 0; i < n_azimuth; ++i) {
      const double angle = 0.5 * arc_angle * i;
      const double w = i % 2 == 1 ? std::cos(0.5 * arc_angle) : 1.0;
      control_points.col(i + n_azimuth * j) << profile.rho[j] * std::cos(angle) / w,
          profile.rho[j] * std::sin(angle) / w, profile.z[j];
      weights.push_back(w * profile.weight[j]);
    }
  return {Space<2>({KnotVector(2, knots), profile.knots}, weights), control_points};
}

double arc_parameter(double angle, double arc_angle) {
  return 0.5 * (1.0 + std::tan(0.5 * angle - 0.25 * arc_angle) / std::tan(0.25 * arc_angle));
}

KnotVector random_knots(Random& random, int degree, int elements) {
  std::vector<double> knots(degree + 1, 0.0);
  double xi = 0.0;
  for (int e = 1; e < elements; ++e) {
    xi += std::exp(uniform(random, -2.0, 2.0));
    knots.insert(knots.end(), std::uniform_int_distribution<int>(1, degree)(random), xi);
  }
  knots.insert(knots.end(), degree + 1, xi + 1.0);
  return KnotVector(degree, knots);
}

std::vector<double> random_weights(Random& random, int count) {
  std::vector<double> weights(count);
  for (double& w : weights) w = uniform(random, 0.5, 2.0);
  return weights;
}

template <int Dim, size_t... Direction>
static std::array<KnotVector, Dim> random_knot_vectors(Random& random, int max_degree, int elements,
                                                       std::index_sequence<Direction...>) {
  std::uniform_int_distribution<int> degree(1, max_degree);
  return {((void)Direction, random_knots(random, degree(random), elements))...};
}

template <int Dim>
Patch<Dim> random_patch(Random& random, int max_degree, int elements, bool rational) {
  Space<Dim> space(random_knot_vectors<Dim>(random, max_degree, elements, std::make_index_sequence<Dim>()));
  if (rational) space = Space<Dim>(space.knots(), random_weights(random, space.control_point_count()));
  NodalVectors control_points(3, space.control_point_count());
  for (double& x : control_points.reshaped()) x = uniform(random, 0.0, 1.0);
  return {std::move(space), std::move(control_points)};
}
template Patch<1> random_patch<1>(Random&, int, int, bool);
template Patch<2> random_patch<2>(Random&, int, int, bool);
template Patch<3> random_patch<3>(Random&, int, int, bool);

Surface random_hills(Random& random, const std::array<KnotVector, 2>& knots, double height, bool rational) {
  Space<2> space(knots);
  if (rational) space = Space<2>(knots, random_weights(random, space.control_point_count()));
  NodalVectors control_points(3, space.control_point_count());
  int a = 0;
  for (double y : knots[1].greville())
    for (double x : knots[0].greville())
      control_points.col(a++) << x / knots[0].back(), y / knots[1].back(), uniform(random, -height, height);
  return {std::move(space), std::move(control_points)};
}

}  // namespace nurbs::shapes

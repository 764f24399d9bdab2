// SPDX-License-Identifier: GPL-2.0-or-later
#include "trial_surfaces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "nurbs/curvature.h"
#include "nurbs/primitives.h"
#include "nurbs/refinement.h"

namespace nurbs::trials {
namespace {

using shapes::Random;
using shapes::uniform;

int integer(Random& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}
double power_of_ten(Random& random, double low, double high) {
  return std::pow(10.0, uniform(random, low, high));
}
Vector3 direction(Random& random) {
  std::normal_distribution<double> normal;
  return Vector3(normal(random), normal(random), normal(random)).normalized();
}

KnotVector graded_knots(Random& random, int degree, int elements) {
  std::vector<double> breaks{uniform(random, -1.0, 1.0)};
  for (int e = 0; e < elements; ++e) breaks.push_back(breaks.back() + power_of_ten(random, -0.3, 0.3));
  return KnotVector::from_breaks(degree, breaks);
}

// Control points over a grid of unit elements, moved by up to `sideways` and `height` elements.
Surface grid(Random& random, bool creased, double sideways, double height) {
  std::vector<KnotVector> knots;
  for (int i = 0; i < 2; ++i) {
    const int degree = integer(random, 2, 5), elements = integer(random, 1, 5);
    knots.push_back(creased ? shapes::random_knots(random, degree, elements)
                            : graded_knots(random, degree, elements));
  }
  Space<2> space({knots[0], knots[1]});
  if (integer(random, 0, 1) == 1)
    space = Space<2>(space.knots(), shapes::random_weights(random, space.control_point_count()));
  NodalVectors P(3, space.control_point_count());
  const auto place = [&](int i, double greville) {
    const double length = knots[i].back() - knots[i].front();
    return knots[i].element_count() * (greville - knots[i].front()) / length +
           uniform(random, -sideways, sideways);
  };
  int a = 0;
  for (const double y : knots[1].greville())
    for (const double x : knots[0].greville())
      P.col(a++) << place(0, x), place(1, y), uniform(random, -height, height);
  return {std::move(space), std::move(P)};
}

// Raises degrees and inserts knots, which leaves the shape as it is.
Surface refined(Random& random, Surface surface) {
  constexpr double kLeastElement = 1e-3;  // of an arc or profile
  for (int i = 0; i < 2; ++i) {
    const int least = std::max(2 - surface.space.degree(i), 0);
    const int times = integer(random, least, 5 - surface.space.degree(i));
    if (times > 0) surface = elevate_degree(surface, i, times);
    for (int k = integer(random, 0, 3); k > 0; --k) {
      const KnotVector knots = surface.space.knots(i);
      const double xi = uniform(random, knots.front(), knots.back());
      const auto beside = [xi](double knot) { return std::abs(knot - xi) < kLeastElement; };
      if (std::none_of(knots.breaks().begin(), knots.breaks().end(), beside))
        surface = insert_knot(surface, i, xi);
    }
  }
  return surface;
}

Surface arcs_turned(Random& random, const shapes::Profile& profile) {
  const int arcs = integer(random, 1, 4);
  const double most = std::min(2.0, 2.0 * M_PI / arcs);  // [rad] per arc
  return refined(random, shapes::revolve(profile, uniform(random, 0.5, most), arcs));
}

Surface with_pole(Random& random) {
  if (integer(random, 0, 1) == 0)
    return arcs_turned(random, shapes::quarter_arc(0.0, uniform(random, 0.5, 2.0)));
  Surface tent = grid(random, false, 0.2, 0.5);
  const int n = tent.space.control_point_count(0);
  for (int i = 0; i < n; ++i) tent.control_points.col(i) = tent.control_points.col(0);
  return tent;
}

Surface exact(Random& random) {
  const double radius = uniform(random, 0.5, 2.0);
  if (integer(random, 0, 1) == 0) return arcs_turned(random, shapes::line(radius, uniform(random, 0.5, 3.0)));
  return arcs_turned(random, shapes::quarter_arc(radius * uniform(random, 1.1, 3.0), radius));
}

Surface ball(Random& random) {
  const auto range = [&](double full) {
    if (integer(random, 0, 1) == 0) return std::array{0.0, full};
    const double from = uniform(random, 0.0, 0.5) * full;
    return std::array{from, from + uniform(random, 0.2, 0.5) * full};
  };
  const auto [west, east] = range(360.0);
  const auto [south, north] = range(180.0);
  return refined(random, nurbs::sphere(frame(Vector3::Zero(), direction(random)), uniform(random, 0.5, 2.0),
                                       arc(west, east), arc(south - 90.0, north - 90.0)));
}

// Control points on a spiral of radii 1 to 1.3 over one and a half to three turns.
Surface spiral(Random& random) {
  Surface sheet = grid(random, false, 0.02, 0.0);
  const KnotVector& along = sheet.space.knots(0);
  const double turns = uniform(random, 1.5, 3.0), gap = uniform(random, 0.05, 0.15);
  const int degree = along.degree(), elements = integer(random, 6, 12);
  const Space<2> space({KnotVector::uniform(degree, elements), sheet.space.knots(1)});
  const std::vector<double> places = space.knots(0).greville(), across = space.knots(1).greville();
  NodalVectors P(3, space.control_point_count());
  int a = 0;
  for (const double y : across)
    for (const double t : places) {
      const double angle = 2.0 * M_PI * turns * t,
                   radius = 1.0 + gap * turns * t + uniform(random, 0.0, 0.01);
      P.col(a++) << radius * std::cos(angle), radius * std::sin(angle), y - across.front();
    }
  return {space, P};
}

Surface unit_surface(Random& random, Family family) {
  switch (family) {
    case Family::hills:
      return grid(random, false, 0.1, 0.3);
    case Family::rough:
      return grid(random, false, 0.2, 2.0);
    case Family::folded:
      return grid(random, false, 1.0, 1.0);
    case Family::creased:
      return grid(random, true, 0.1, 0.7);
    case Family::pole:
      return with_pole(random);
    case Family::ball:
      return ball(random);
    case Family::spiral:
      return spiral(random);
    case Family::exact:
      break;
  }
  return exact(random);
}

// A parameter in the domain; on a border if `border` is 0 (low) or 1 (high).
double parameter(Random& random, const KnotVector& knots, int border) {
  if (border >= 0) return border == 0 ? knots.front() : knots.back();
  return uniform(random, knots.front(), knots.back());
}

// From inside to the point at xi of the border, with the length 1.
Vector3 outward(const Surface& surface, const Parameter<2>& xi) {
  Parameter<2> inside;
  for (int i = 0; i < 2; ++i) {
    const KnotVector& knots = surface.space.knots(i);
    inside[i] = xi[i] + 1e-3 * (0.5 * (knots.front() + knots.back()) - xi[i]);
  }
  const Vector3 out = interpolate(surface.space, surface.control_points, xi) -
                      interpolate(surface.space, surface.control_points, inside);
  return out / std::max(out.norm(), 1e-300);
}

// The centre of one of the two curvatures at xi; of a plane or a sharp edge some elements away.
Vector3 centre_of_curvature(Random& random, const TrialSurface& trial, const Parameter<2>& xi) {
  const MultiPatch patch({trial.surface.space});
  const SurfaceShape shape = shape_at(patch, trial.surface.control_points, {0, xi});
  const double curvature = shape.curvature[integer(random, 0, 1)], least = 0.1 / trial.element;
  if (!(std::abs(curvature) < 1e3 / trial.element)) return shape.point;
  return shape.point + shape.normal / std::copysign(std::max(std::abs(curvature), least), curvature);
}

}  // namespace

const char* name(Family family) {
  static const char* const names[kFamilies] = {"hills", "rough", "folded", "creased",
                                               "pole",  "exact", "ball",   "spiral"};
  return names[static_cast<int>(family)];
}

const char* name(Place place) {
  static const char* const names[kPlaces] = {"close", "bulk", "far", "edge", "corner", "line", "centre"};
  return names[static_cast<int>(place)];
}

TrialSurface random_surface(Random& random, Family family) {
  TrialSurface trial{unit_surface(random, family), family, power_of_ten(random, -4.0, 3.0), Vector3::Zero()};
  NodalVectors& P = trial.surface.control_points;
  const Eigen::AngleAxisd rotation(uniform(random, 0.0, 2.0 * M_PI), direction(random));
  P = (trial.element * rotation.toRotationMatrix() * P).eval();
  if (integer(random, 0, 2) == 0) trial.centre = 1e3 * trial.element * direction(random);
  P.colwise() += trial.centre;
  return trial;
}

Vector3 random_point(Random& random, const TrialSurface& trial, Place place) {
  const Surface& surface = trial.surface;
  Parameter<2> xi;
  const int side = integer(random, 0, 1);
  for (int i = 0; i < 2; ++i) {
    const bool border = place == Place::corner || (place == Place::edge && i == side);
    xi[i] = parameter(random, surface.space.knots(i), border ? integer(random, 0, 1) : -1);
  }
  if (place == Place::line) {
    const std::vector<double>& breaks = surface.space.knots(side).breaks();
    xi[side] = breaks[integer(random, 0, static_cast<int>(breaks.size()) - 1)];
  }
  const Vector3 S = interpolate(surface.space, surface.control_points, xi);
  const Vector3 size =
      surface.control_points.rowwise().maxCoeff() - surface.control_points.rowwise().minCoeff();
  switch (place) {
    case Place::close:
      return S + trial.element * power_of_ten(random, -6.0, 0.0) * direction(random);
    case Place::bulk:
      if (trial.family == Family::exact && integer(random, 0, 7) == 0)
        return trial.centre;  // equally far from all
      return S + trial.element * uniform(random, 0.5, 4.0) * direction(random);
    case Place::far:
      return S + size.norm() * power_of_ten(random, 0.0, 1.3) * direction(random);
    case Place::edge:
    case Place::corner:
      return S + trial.element * power_of_ten(random, -2.0, 0.5) *
                     (outward(surface, xi) + uniform(random, 0.0, 0.7) * direction(random));
    case Place::centre: {
      const Vector3 centre =
          trial.family == Family::ball ? trial.centre : centre_of_curvature(random, trial, xi);
      if (integer(random, 0, 7) == 0) return centre;
      return centre + (S - centre).norm() * power_of_ten(random, -17.0, -5.0) * direction(random);
    }
    case Place::line:
      break;
  }
  return S + trial.element * power_of_ten(random, -3.0, 0.5) * direction(random);
}

Parameter<2> guess_beside(Random& random, const Space<2>& space, const Parameter<2>& xi, double elements) {
  const double angle = uniform(random, 0.0, 2.0 * M_PI);
  const double step[2] = {elements * std::cos(angle), elements * std::sin(angle)};
  Parameter<2> guess;
  for (int i = 0; i < 2; ++i) {
    const KnotVector& knots = space.knots(i);
    const int e = knots.element_at(xi[i]);
    guess[i] = std::clamp(xi[i] + step[i] * (knots.breaks()[e + 1] - knots.breaks()[e]), knots.front(),
                          knots.back());
  }
  return guess;
}

}  // namespace nurbs::trials

// SPDX-License-Identifier: GPL-2.0-or-later
#include "surfaces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "nurbs/primitives.h"

namespace benchmarks {
namespace {

using nurbs::KnotVector;
using nurbs::Parameter;
using nurbs::Surface;
using nurbs::Vector3;

constexpr double kFarthest = 0.06;  // of the points from the surface, which is as long as 1

template <class Height>
Surface raised_plane(const Vector3& edge_u, const Vector3& edge_v, int n, Height height) {
  const KnotVector knots = KnotVector::uniform(2, n);
  Surface surface = nurbs::plane(-0.5 * (edge_u + edge_v), edge_u, edge_v, {knots, knots});
  for (auto x : surface.control_points.colwise()) x.z() = height(x.x(), x.y());
  return surface;
}

/// Of the unit cylinder, of length 1.
Surface quarter_cylinder(int n) {
  const nurbs::Frame frame = nurbs::frame(Vector3::Zero(), Vector3::UnitY());
  return nurbs::cylinder(frame, 1.0, 1.0, nurbs::refined(nurbs::arc(0.0, 90.0), n, 2),
                         KnotVector::uniform(2, n));
}

double clamped(double xi, const KnotVector& knots) { return std::clamp(xi, knots.front(), knots.back()); }

}  // namespace

Surface make_surface(const std::string& name, int n) {
  const Vector3 ex = Vector3::UnitX(), ey = Vector3::UnitY();
  if (name == "plate") return raised_plane(ex, ey, n, [](double, double) { return 0.0; });
  if (name == "wavy") {
    const double k = 4.0 * M_PI, amplitude = 0.03;
    return raised_plane(ex, ey, n,
                        [=](double x, double y) { return amplitude * std::sin(k * x) * std::sin(k * y); });
  }
  if (name == "cylinder") return quarter_cylinder(n);
  if (name == "saddle")
    return raised_plane(ex, Vector3(0.6, 0.8, 0.0), n, [](double x, double y) { return x * x - y * y; });
  if (name ==
      "rippled") {  // two waves on the saddle, whose radii of curvature are four times the farthest point
    const double k = 4.0 * M_PI, amplitude = 1.0 / (4.0 * kFarthest * k * k);
    return raised_plane(ex, Vector3(0.6, 0.8, 0.0), n, [=](double x, double y) {
      return x * x - y * y + amplitude * std::sin(k * x) * std::sin(k * y);
    });
  }
  throw std::invalid_argument("surface is \"" + name +
                              "\", expected plate, wavy, cylinder, saddle or rippled");
}

std::vector<Query> make_queries(const Surface& surface, int count) {
  const nurbs::Space<2>& space = surface.space;
  std::mt19937 random(2019);
  std::uniform_real_distribution<double> anywhere(0.0, 1.0), offset(-kFarthest, kFarthest);
  std::bernoulli_distribution up;
  std::vector<Query> queries(count);
  nurbs::RationalBasis<2> basis;
  for (Query& query : queries) {
    Parameter<2> xi;
    for (int i : {0, 1}) {
      const KnotVector& knots = space.knots(i);
      const double range = knots.back() - knots.front();
      xi[i] = knots.front() + range * anywhere(random);
      query.guess[i] = clamped(xi[i] + (up(random) ? 0.01 : -0.01) * range / knots.element_count(), knots);
    }
    nurbs::evaluate(space, xi, 1, basis);
    Vector3 S_xi = Vector3::Zero(), S_eta = Vector3::Zero();
    for (int a = 0; a < basis.count; ++a) {
      S_xi += basis.dR[0][a] * surface.control_points.col(basis.control_point[a]);
      S_eta += basis.dR[1][a] * surface.control_points.col(basis.control_point[a]);
    }
    query.foot = nurbs::interpolate<2>(basis, surface.control_points);
    query.d = query.foot + offset(random) * S_xi.cross(S_eta).normalized();
  }
  return queries;
}

}  // namespace benchmarks

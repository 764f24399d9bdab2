// SPDX-License-Identifier: GPL-2.0-or-later
// Forces that are spread over the net about their foot, as far as the pressure of a contact after Hertz: what
// the mesh gives way under them, beyond what a half-space does.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "point_force.h"
#include "structure/compliance/element_compliances.h"
#include "structure/compliance/net_mean.h"

namespace {

using nurbs::NodalVectors;
using nurbs::Parameter;
using nurbs::Vector3;
using point_force::displacements;
using point_force::kTop;
using point_force::unit_force;

structure::ReferenceBody block(const Vector3& size, const std::array<int, 3>& elements, int degree) {
  return point_force::block_body(size, elements, degree);
}

/// Along the normal: Z of a foot.
NodalVectors beside(const structure::ReferenceBody& body, const Parameter<2>& xi) {
  const structure::FaceSurface top(body, kTop[0]);
  const structure::NetMean::Beside beside =
      structure::NetMean(body, kTop).beside(top.at(top.space().element_at(xi), xi));
  NodalVectors load = NodalVectors::Zero(3, body.patches[0].control_points.cols());
  for (std::size_t a = 0; a < beside.nodes.size(); ++a) load(2, beside.nodes[a]) = beside.Z[a];
  return load;
}

double work(const NodalVectors& a, const NodalVectors& b) { return a.cwiseProduct(b).sum(); }

TEST(NetMean, HasNoForceNoMomentAndTheMomentsOfItsName) {
  for (const int degree : {2, 3}) {
    const structure::ReferenceBody body = block({10, 20, 4}, {10, 10, 4}, degree);
    const NodalVectors Z = beside(body, {0.53, 0.48});
    const NodalVectors& X = body.patches[0].control_points;
    EXPECT_NEAR(Z.row(2).sum(), 0.0, 1e-14);
    EXPECT_NEAR(Z.row(2).dot(X.row(0)), 0.0, 1e-13);
    EXPECT_NEAR(Z.row(2).dot(X.row(1)), 0.0, 1e-13);
    EXPECT_NEAR(Z.row(2).dot(X.row(0).cwiseAbs2()), 0.4, 1e-12);
    EXPECT_NEAR(Z.row(2).dot(X.row(1).cwiseAbs2()), 0.4 * 4.0, 1e-12);
  }
}

TEST(SpreadForces, GiveWayOnTablesAsOnAWholeBlock) {
  for (const int degree : {2, 3}) {
    const structure::ReferenceBody body = block({14, 14, 6}, {14, 14, 6}, degree);
    structure::ElementCompliances compliances(body, kTop);
    const auto on_base = [](const Vector3& X) { return X[2] < 1e-9; };
    for (const Parameter<2>& foot : {Parameter<2>{7, 7}, {7.5, 7.5}, {7.25, 7.4}}) {
      const Parameter<2> xi = {foot[0] / 14, foot[1] / 14};
      const NodalVectors R = unit_force(body, xi), Z = beside(body, xi),
                         u = displacements(body, R, on_base), of_Z = displacements(body, Z, on_base);
      const auto found = compliances.spread_direct(0, 7 + 14 * 7, xi);
      std::printf("%d %.2f: one %.4f %.4f both %.4f %.4f\n", degree, foot[0], work(u, Z), found.one(2, 2), work(of_Z, Z),
                  found.both(2, 2));
    }
  }
}

TEST(SpreadForces, OnPlates) {
  // plate of 12 x 12 x 1
  const double a = 1.41421356;
  const auto rim = [](const Vector3& X) { return X[0] < 1e-9 || X[1] < 1e-9 || X[0] > 12 - 1e-9 || X[1] > 12 - 1e-9; };
  const double Ep = 1 / (1 - point_force::kNu * point_force::kNu);
  double g = 0;
  {
    const structure::ReferenceBody body = block({12, 12, 1}, {48, 48, 4}, 2);
    NodalVectors f = 0.0 * unit_force(body, {0.5, 0.5});
    const int rings = 6, n = 16;
    for (int i = 0; i < rings; ++i) {
      const double t = (i + 0.5) / rings, r = a * std::sqrt(1 - std::pow(1 - t, 2.0 / 3));
      for (int k = 0; k < n; ++k) {
        const double w = 2 * M_PI * (k + 0.5 * (i % 2)) / n;
        f += unit_force(body, {(6 + r * std::cos(w)) / 12, (6 + r * std::sin(w)) / 12}) / (rings * n);
      }
    }
    g = work(f, displacements(body, f, rim)) - 3 / (5 * Ep * a);
    std::printf("g of disc %.4f\n", g);
  }
  for (int degree : {2, 3}) {
    const structure::ReferenceBody body = block({12, 12, 1}, {12, 12, 1}, degree);
    structure::ElementCompliances compliances(body, kTop);
    const Parameter<2> xi = {0.5, 0.5};
    const NodalVectors R = unit_force(body, xi), Z = beside(body, xi), u = displacements(body, R, rim), of_Z = displacements(body, Z, rim);
    const auto found = compliances.spread_direct(0, 6 + 12 * 6, xi);
    const double c = compliances.direct(0, 6 + 12 * 6, xi)(2, 2);
    for (double w : {0.0, 0.25, 0.5, 1.0})
    std::printf("%d w %.2f: whole %.4f c %.4f (one %.4f, %.4f both %.4f, %.4f) left %.4f\n", degree, w, work(R + w * Z, u + w * of_Z), c + 2 * w * found.one(2, 2) + w * w * found.both(2, 2),
                work(u, Z), found.one(2, 2), work(of_Z, Z), found.both(2, 2), work(R + w * Z, u + w * of_Z) - (c + 2 * w * found.one(2, 2) + w * w * found.both(2, 2)));
  }
}

}  // namespace

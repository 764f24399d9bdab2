// SPDX-License-Identifier: GPL-2.0-or-later
// Seams that contacts meet without a kink: where nodes are met, and what the mesh gives way there.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "nurbs/primitives.h"
#include "nurbs/refinement.h"
#include "point_force.h"
#include "structure/compliance/element_compliances.h"
#include "structure/compliance/smooth_seams.h"

namespace {

using nurbs::NodalVectors;
using nurbs::Parameter;
using nurbs::Vector3;
using nurbs::Volume;
using point_force::kTop;
using structure::Id;
using structure::SmoothSeams;

structure::ReferenceBody body_of(const std::vector<Volume>& patches) {
  const std::vector<std::shared_ptr<const structure::Material>> materials(
      patches.size(), models::elastic(1.0, point_force::kNu));
  return {patches, materials, structure::weld(patches)};
}

std::vector<structure::SkinPiece> tops(int patches) {
  std::vector<structure::SkinPiece> skin;
  for (int p = 0; p < patches; ++p) skin.push_back({p, nurbs::Face::zeta_plus});
  return skin;
}

Volume moved(Volume patch, double x, double y) {
  patch.control_points.row(0).array() += x;
  patch.control_points.row(1).array() += y;
  return patch;
}

NodalVectors places(const structure::ReferenceBody& body) {
  NodalVectors X(3, body.nodes.node_count());
  for (Id node = 0; node < body.nodes.node_count(); ++node) X.col(node) = body.place(node);
  return X;
}

/// Where all nodes are met that the body has at q.
NodalVectors met(const SmoothSeams& seams, const NodalVectors& q) {
  NodalVectors met = q;
  const auto shares = seams.shares();
  for (const auto& share : shares) met.col(share.from).setZero();
  for (const auto& [from, to, share] : shares) met.col(from) += share * q.col(to);
  return met;
}

/// Rows that come to y = 0 from one side and leave it on the other as in a V, each by `slope`.
structure::ReferenceBody askew(int degree, double slope) {
  const Volume block = models::block({8, 8, 4}, {8, 8, 4}, degree);
  std::vector<Volume> patches = {moved(block, -8, 0), block};
  for (Volume& patch : patches)
    for (int a = 0; a < patch.control_points.cols(); ++a) {
      const double x = std::abs(patch.control_points(0, a)), y = patch.control_points(1, a);
      patch.control_points(1, a) += slope * x * (1.0 - x / 8.0) * std::pow(std::sin(M_PI * y / 8.0), 2);
    }
  return body_of(patches);
}

/// The largest angle between normals on both sides of where two patches' sides meet, xi+ and xi-, or eta+ and
/// eta-.
double largest_kink(const structure::ReferenceBody& body, const NodalVectors& q, int left, int right, int d) {
  double largest = 0.0;
  for (const double s : {0.1, 0.35, 0.5, 0.8}) {
    Vector3 normal[2];
    for (int side = 0; side < 2; ++side) {
      const int p = side == 0 ? left : right;
      const nurbs::BoundarySurface face =
          nurbs::boundary_surface(body.patches[p].space, nurbs::Face::zeta_plus);
      Parameter<2> xi = {s, s};
      xi[d] = side == 0 ? 1.0 : 0.0;
      nurbs::RationalBasis<2> basis;
      nurbs::evaluate(face.space, xi, 1, basis);
      Vector3 t[2] = {Vector3::Zero(), Vector3::Zero()};
      for (int a = 0; a < basis.count; ++a)
        for (int k = 0; k < 2; ++k)
          t[k] +=
              basis.dR[k][a] * q.col(body.nodes.node(p, face.volume_control_point[basis.control_point[a]]));
      normal[side] = t[0].cross(t[1]).normalized();
    }
    largest = std::max(largest, normal[0].cross(normal[1]).norm());
  }
  return largest;
}

NodalVectors shaken(const NodalVectors& X) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-0.1, 0.1);
  return X + NodalVectors::NullaryExpr(3, X.cols(), [&] { return any(random); });
}

TEST(SmoothSeams, StayWithoutKinksWhateverTheBodyDoes) {
  for (const int degree : {2, 3}) {
    const Volume block = models::block({4, 4, 2}, {4, 4, 2}, degree);
    const structure::ReferenceBody body =
        body_of({block, moved(block, 4, 0), moved(block, 0, 4), moved(block, 4, 4)});
    const SmoothSeams seams(body, tops(4));
    const NodalVectors X = places(body), q = shaken(X);
    EXPECT_GT(largest_kink(body, q, 0, 1, 0), 0.05);
    for (const auto& [left, right, d] : {std::array{0, 1, 0}, {2, 3, 0}, {0, 2, 1}, {1, 3, 1}})
      EXPECT_LT(largest_kink(body, met(seams, q), left, right, d), 1e-12) << degree;
  }
}

// An undeformed surface is met where it is, and one that is moved by any affine map; so no force and no
// moment is lost either.
TEST(SmoothSeams, LeaveAffineMapsAsTheyAre) {
  nurbs::Volume curved = nurbs::insert_knot(models::block({4, 4, 2}, {4, 4, 2}, 3), 0, 0.5, 2);
  NodalVectors& X = curved.control_points;
  for (Eigen::Index a = 0; a < X.cols(); ++a) {  // round the seam, which stays straight across
    const double away = X(0, a) - 2.0, sign = away < 0.0 ? -1.0 : 1.0;
    if (std::abs(away) > 0.4) X(2, a) -= 0.1 * sign * away * sign * away;
  }
  const structure::ReferenceBody body = body_of({curved});
  const SmoothSeams seams(body, kTop);
  const NodalVectors at = places(body);
  EXPECT_FALSE(seams.shares().empty());
  EXPECT_LT((met(seams, at) - at).cwiseAbs().maxCoeff(), 1e-14);
  const NodalVectors turned = (Eigen::Matrix3d::Random() * at).colwise() + Vector3(1, 2, 3);
  EXPECT_LT((met(seams, turned) - turned).cwiseAbs().maxCoeff(), 1e-13);
}

// Where rows of control points do not run straight across a seam: affine maps stay, and so does most of what
// is smooth; of the kinks that a body makes a sixth is left.
TEST(SmoothSeams, AreMetWhereRowsAreAskew) {
  for (const int degree : {2, 3}) {
    const structure::ReferenceBody body = askew(degree, 0.3);
    const SmoothSeams seams(body, tops(2));
    const NodalVectors X = places(body);
    EXPECT_LT((met(seams, X) - X).cwiseAbs().maxCoeff(), 1e-13);
    const NodalVectors turned = (Eigen::Matrix3d::Random() * X).colwise() + Vector3(1, 2, 3);
    EXPECT_LT((met(seams, turned) - turned).cwiseAbs().maxCoeff(), 1e-12);
    NodalVectors dented = X;  // over some elements
    for (Eigen::Index a = 0; a < X.cols(); ++a)
      dented(2, a) -= 0.2 / (1.0 + (X.col(a) - Vector3(0.3, 4.2, 4.0)).squaredNorm());
    const double kink = largest_kink(body, dented, 0, 1, 0),
                 left = largest_kink(body, met(seams, dented), 0, 1, 0);
    EXPECT_GT(kink, 0.02) << degree;
    EXPECT_LT(6.0 * left, kink) << degree;
  }
}

// Three patches that meet in a point: their seams are met but for it and
// what is beside it, where two seams have one node beside them.  A chamfer and
// the end of a skin are no kinks of a mesh.
TEST(SmoothSeams, KnowKinksThatStay) {
  std::vector<Volume> rhombs;
  for (int p = 0; p < 3; ++p) {
    rhombs.push_back(models::block({6, 6, 3}, {6, 6, 3}, 2));
    const double from = 2.0 * M_PI / 3.0 * p, to = 2.0 * M_PI / 3.0 * (p + 1);
    Eigen::Matrix3d ways = Eigen::Matrix3d::Identity();
    ways.col(0) << std::cos(from), std::sin(from), 0.0;
    ways.col(1) << std::cos(to), std::sin(to), 0.0;
    rhombs.back().control_points = (ways * rhombs.back().control_points).eval();
  }
  const structure::ReferenceBody body = body_of(rhombs);
  const std::vector<Id> kinks = SmoothSeams(body, tops(3)).kinks();
  ASSERT_EQ(kinks.size(), 4u);
  for (const Id node : kinks) EXPECT_LT(body.place(node).head<2>().norm(), 0.51);

  const Volume left = models::block({4, 4, 2}, {4, 4, 2}, 2);
  Volume right = moved(left, 4, 0);
  EXPECT_TRUE(SmoothSeams(body_of({left, right}), tops(2)).kinks().empty());
  right.control_points.row(2) -= (right.control_points.row(0).array() - 4.0).matrix();
  EXPECT_TRUE(SmoothSeams(body_of({left, right}), tops(2)).kinks().empty());
}

TEST(SmoothSeams, AreNoEdges) {
  const Volume left = models::block({4, 4, 2}, {4, 4, 2}, 2);
  Volume right = moved(left, 4, 0);
  right.control_points.row(2) -= 0.001 * (right.control_points.row(0).array() - 4.0).matrix();
  EXPECT_TRUE(SmoothSeams(body_of({left, right}), tops(2)).shares().empty());
  EXPECT_TRUE(SmoothSeams(body_of({left}), {{0, nurbs::Face::zeta_plus}, {0, nurbs::Face::xi_plus}})
                  .shares()
                  .empty());
}

TEST(SmoothSeams, CarryForcesAsTheyTakePlaces) {
  const Volume block = models::block({4, 4, 2}, {4, 4, 2}, 3);
  const structure::ReferenceBody body = body_of({block, moved(block, 4, 0)});
  const SmoothSeams seams(body, tops(2));
  const NodalVectors q = shaken(places(body)), at = met(seams, q);
  const structure::FaceSurface top(body, kTop[0]);
  const structure::SkinPoint foot = top.at(top.space().element_at({0.9, 0.4}), {0.9, 0.4}),
                             carried = seams.carried(foot);
  Vector3 of_surface = Vector3::Zero(), of_body = Vector3::Zero();
  for (std::size_t a = 0; a < foot.nodes.size(); ++a) of_surface += foot.R[a] * at.col(foot.nodes[a]);
  for (std::size_t a = 0; a < carried.nodes.size(); ++a) of_body += carried.R[a] * q.col(carried.nodes[a]);
  EXPECT_LT((of_surface - of_body).norm(), 1e-14);
}

/// Of a unit force along the normal, by R as it is.
NodalVectors with_kink(const structure::ReferenceBody& body, const Parameter<2>& xi) {
  const structure::FaceSurface top(body, kTop[0]);
  const structure::SkinPoint foot = top.at(top.space().element_at(xi), xi);
  NodalVectors load = NodalVectors::Zero(3, body.patches[0].control_points.cols());
  for (std::size_t a = 0; a < foot.nodes.size(); ++a) load(2, foot.nodes[a]) = foot.R[a];
  return load;
}

// On three elements beside a seam a force on a mesh with one gives way by what it does on a mesh without, but
// for some hundredths of 1/(E h); on the seam with the kink by half as much again and more.
TEST(SmoothSeams, GiveWayAsWithoutASeam) {
  for (const int degree : {2, 3}) {
    const structure::ReferenceBody plain = point_force::block_body({14, 14, 6}, {14, 14, 6}, degree),
                                   seamed = point_force::body_of(
                                       nurbs::insert_knot(plain.patches[0], 0, 0.5, degree - 1));
    structure::ElementCompliances of_seamed(seamed, kTop), of_plain(plain, kTop);
    const auto on_base = [](const Vector3& x) { return x[2] < 1e-9; };
    for (const Parameter<2>& foot :
         {Parameter<2>{7, 7}, {7, 7.5}, {7.25, 7.25}, {7.5, 7.5}, {8.25, 7.25}, {9.5, 7.25}, {10.2, 7.5}}) {
      const Parameter<2> xi = {foot[0] / 14, foot[1] / 14};
      const double with = point_force::mesh_compliance(seamed, xi, on_base),
                   without = point_force::mesh_compliance(plain, xi, on_base);
      EXPECT_NEAR(with, without, degree == 2 ? 0.02 : 0.05) << degree << " at " << foot[0] << ", " << foot[1];
      if (foot[0] == 7.0) {
        const NodalVectors load = with_kink(seamed, xi);
        EXPECT_GT(load.cwiseProduct(point_force::displacements(seamed, load, on_base)).sum(), 1.4 * without);
      }
      const int element = static_cast<int>(foot[0]) + 14 * 7;  // tables have it, too
      EXPECT_NEAR(of_seamed.direct(0, element, xi)(2, 2) - of_plain.direct(0, element, xi)(2, 2),
                  with - without, 0.02);
      EXPECT_EQ(of_seamed.solved(0, element).problem, "");
      EXPECT_EQ(of_seamed.solved_spread(0, element).problem, "");
    }
  }
}

}  // namespace

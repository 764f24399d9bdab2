// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/boundary.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "nurbs/primitives.h"
#include "nurbs/shapes.h"

namespace nurbs {
namespace {

constexpr Face kFaces[] = {Face::xi_minus, Face::xi_plus,    Face::eta_minus,
                           Face::eta_plus, Face::zeta_minus, Face::zeta_plus};

NodalVectors face_points(const Volume& volume, const BoundarySurface& face) {
  NodalVectors points(3, face.space.control_point_count());
  for (int a = 0; a < points.cols(); ++a)
    points.col(a) = volume.control_points.col(face.volume_control_point[a]);
  return points;
}

// The volume's parameters of a face's parameters.
Parameter<3> on_face(const Space<3>& volume, int face, const Parameter<2>& uv) {
  const int normal = face / 2;
  Parameter<3> xi;
  int next = 0;
  for (int d = 0; d < 3; ++d)
    xi[d] = d != normal ? uv[next++] : face % 2 ? volume.knots(d).back() : volume.knots(d).front();
  return xi;
}

TEST(Boundary, FaceEqualsVolumeThere) {
  shapes::Random random(1);
  for (const bool rational : {false, true}) {
    const Volume volume = shapes::random_patch<3>(random, 3, 3, rational);
    for (int f = 0; f < 6; ++f) {
      const BoundarySurface face = boundary_surface(volume.space, kFaces[f]);
      ASSERT_EQ(static_cast<int>(face.volume_control_point.size()), face.space.control_point_count());
      const NodalVectors points = face_points(volume, face);
      for (int k = 0; k < 20; ++k) {
        const Parameter<2> uv = shapes::random_parameter(random, face.space);
        const Vector3 in_volume =
            interpolate(volume.space, volume.control_points, on_face(volume.space, f, uv));
        EXPECT_NEAR((interpolate(face.space, points, uv) - in_volume).norm(), 0.0, 1e-14)
            << face_name(kFaces[f]);
      }
    }
  }
}

// On a right-handed block the signed normal of each face points away from the centre.
TEST(Boundary, OutwardSign) {
  const Volume block = box({0, 0, 0}, {1, 2, 3},
                           {KnotVector::uniform(2, 2), KnotVector::uniform(1, 2), KnotVector::uniform(3, 1)});
  const Vector3 centre(0.5, 1.0, 1.5);
  for (int f = 0; f < 6; ++f) {
    const BoundarySurface face = boundary_surface(block.space, kFaces[f]);
    const NodalVectors points = face_points(block, face);
    RationalBasis<2> basis;
    evaluate(face.space, {0.5, 0.5}, 1, basis);
    Vector3 S_u = Vector3::Zero(), S_v = S_u;
    for (int a = 0; a < basis.count; ++a) {
      S_u += basis.dR[0][a] * points.col(basis.control_point[a]);
      S_v += basis.dR[1][a] * points.col(basis.control_point[a]);
    }
    const Vector3 outward = face.outward_sign * S_u.cross(S_v);
    EXPECT_GT(outward.dot(interpolate(basis, points) - centre), 0.0) << face_name(kFaces[f]);
  }
}

TEST(Boundary, FaceNames) {
  for (Face face : kFaces) EXPECT_EQ(face_from_name(face_name(face)), face);
  EXPECT_STREQ(face_name(Face::zeta_plus), "zeta+");
  EXPECT_THROW(face_from_name("top"), std::invalid_argument);
}

}  // namespace
}  // namespace nurbs

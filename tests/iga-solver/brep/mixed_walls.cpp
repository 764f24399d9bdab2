// SPDX-License-Identifier: GPL-2.0-or-later
#include "mixed_walls.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "face_grid.h"
#include "trial_walls.h"

namespace brep::trials {
namespace {

constexpr double kQuarter = 0.5 * nurbs::kPi;

double between(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vector3 unit(int axis, double sign = 1.0) { return sign * Vector3::Unit(axis); }

// A frame in which x turns towards y by a quarter, from one of two directions to the other.
Frame corner_frame(const Vector3& origin, const Vector3& z, const Vector3& a, const Vector3& b) {
  return frame_at(origin, z, z.cross(a).dot(b) > 0.0 ? a : b);
}

// Planes, quarters of cylinders on the edges, eighths of spheres on the corners.
std::vector<Face> rounded_box(std::mt19937& random) {
  Vector3 half;
  for (double& h : half) h = between(random, 0.2, 0.6);
  const double R = between(random, 0.1, 0.4);
  std::vector<Face> faces;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    for (const double sk : {-1.0, 1.0}) {
      const Frame plane = frame_at(unit(k, sk * (half[k] + R)), unit(k), unit(i));
      faces.push_back(face_of(Kind::plane, plane, 0.0, 0.0, {-half[i], -half[j]}, {half[i], half[j]}));
      for (const double si : {-1.0, 1.0}) {
        const Frame along =
            corner_frame(unit(i, si * half[i]) + unit(j, sk * half[j]), unit(k), unit(i, si), unit(j, sk));
        faces.push_back(face_of(Kind::cylinder, along, R, 0.0, {0.0, -half[k]}, {kQuarter, half[k]}));
        if (k > 0) continue;
        for (const double sj : {-1.0, 1.0}) {
          const Vector3 centre(sk * half[0], si * half[1], sj * half[2]);
          faces.push_back(face_of(Kind::sphere, corner_frame(centre, unit(2, sj), unit(0, sk), unit(1, si)),
                                  R, 0.0, {0.0, 0.0}, {kQuarter, kQuarter}));
        }
      }
    }
  }
  return faces;
}

// Part of a cylinder, planes from its axis to its sides, and one across them.
std::vector<Face> slice(std::mt19937& random) {
  const double R = between(random, 0.4, 1.0), height = between(random, 0.5, 1.5),
               part = between(random, 0.4, 5.4), angle = part < nurbs::kPi ? part - 0.05 : part + 0.05;
  std::vector<Face> faces{face_of(Kind::cylinder, Frame(), R, 0.0, {0.0, 0.0}, {angle, height})};
  const auto side = [&](const Vector3& a, const Vector3& b) {
    const Vector3 x = (b - a).normalized();
    const Frame frame = frame_at(a, x.cross(unit(2)), x);
    faces.push_back(face_of(Kind::plane, frame, 0.0, 0.0, {0.0, 0.0}, {(b - a).norm(), height}));
  };
  const Vector3 from = R * unit(0), to(R * std::cos(angle), R * std::sin(angle), 0.0);
  if (random() % 3 > 0) side(Vector3::Zero(), from);
  if (random() % 3 > 0) side(Vector3::Zero(), to);
  if (random() % 3 > 0)
    side(from, to);
  else
    side(from, from + Vector3(between(random, 0.1, 1.0) * (random() % 2 == 0 ? 1.0 : -1.0), 0.7, 0.0));
  return faces;
}

// A cylinder over a cone, and an outlet under it.
std::vector<Face> silo(std::mt19937& random) {
  const double R = between(random, 0.5, 1.0), outlet = R * between(random, 0.2, 0.7),
               half = between(random, 0.3, 1.2);
  const auto tip_of = [&](double radius) { return radius / std::sin(half); };
  Frame tip;
  tip.origin = -R / std::tan(half) * unit(2);
  Frame below;
  below.origin = tip.origin + outlet / std::tan(half) * unit(2);
  std::vector<Face> faces{
      face_of(Kind::cylinder, Frame(), R, 0.0, {0.0, 0.0}, {2.0 * nurbs::kPi, between(random, 0.3, 1.0)}),
      face_of(Kind::cone, tip, 0.0, half, {0.0, tip_of(outlet)}, {2.0 * nurbs::kPi, tip_of(R)})};
  if (random() % 2 == 0)
    faces.push_back(face_of(Kind::cylinder, below, outlet, 0.0, {0.0, -0.4}, {2.0 * nurbs::kPi, 0.0}));
  return faces;
}

// Two straight pipes and part of a torus between them.
std::vector<Face> bent_pipe(std::mt19937& random) {
  const double R = between(random, 0.5, 1.0), r = between(random, 0.15, 0.4),
               angle = between(random, 0.5, 2.5);
  const Vector3 radial(std::cos(angle), std::sin(angle), 0.0), on(-std::sin(angle), std::cos(angle), 0.0);
  return {
      face_of(Kind::torus, Frame(), R, r, {0.0, 0.0}, {angle, 2.0 * nurbs::kPi}),
      face_of(Kind::cylinder, frame_at(R * unit(0), unit(1), unit(0)), r, 0.0, {0.0, -0.7},
              {2.0 * nurbs::kPi, 0.0}),
      face_of(Kind::cylinder, frame_at(R * radial, on, radial), r, 0.0, {0.0, 0.0}, {2.0 * nurbs::kPi, 0.5})};
}

// A cylinder with a cap of a sphere on each end, tangent or not.
std::vector<Face> capsule(std::mt19937& random) {
  const double R = between(random, 0.2, 0.6), height = between(random, 0.3, 1.0);
  std::vector<Face> faces{face_of(Kind::cylinder, Frame(), R, 0.0, {0.0, 0.0}, {2.0 * nurbs::kPi, height})};
  for (const double end : {-1.0, 1.0}) {
    const double low = random() % 3 == 0   ? 0.0
                       : random() % 2 == 0 ? between(random, 0.05, 1.2)
                                           : between(random, -0.8, -0.05),
                 ball = R / std::cos(low);
    const Vector3 centre = ((end > 0.0 ? height : 0.0) - end * ball * std::sin(low)) * unit(2);
    faces.push_back(face_of(Kind::sphere, frame_at(centre, unit(2, end), unit(0)), ball, 0.0, {0.0, low},
                            {2.0 * nurbs::kPi, kQuarter}));
  }
  return faces;
}

// Half a pipe or less, and a plane on each side: tangent, or at any angle.
std::vector<Face> gutter(std::mt19937& random) {
  const double R = between(random, 0.3, 0.8), length = between(random, 0.6, 1.5),
               angle = between(random, 0.5, nurbs::kPi);
  std::vector<Face> faces{face_of(Kind::cylinder, Frame(), R, 0.0, {0.0, 0.0}, {angle, length})};
  for (const double at : {0.0, angle}) {
    const Vector3 rim(R * std::cos(at), R * std::sin(at), 0.0), on(-std::sin(at), std::cos(at), 0.0);
    const double turned = random() % 2 == 0 ? 0.0 : between(random, 0.1, 2.5);
    const Vector3 off = (at > 0.0 ? 1.0 : -1.0) * on;
    const Vector3 x = Eigen::AngleAxisd(turned, unit(2)) * off;
    faces.push_back(face_of(Kind::plane, frame_at(rim, x.cross(unit(2)), x), 0.0, 0.0, {0.0, 0.0},
                            {between(random, 0.2, 0.8), length}));
  }
  return faces;
}

}  // namespace

const char* mixed_family_name(int family) {
  constexpr const char* names[kMixedFamilies] = {"rounded box", "slice",   "silo",
                                                 "bent pipe",   "capsule", "gutter"};
  return names[family];
}

std::vector<Face> random_mixed_wall(std::mt19937& random, int family) {
  constexpr std::vector<Face> (*kMake[kMixedFamilies])(std::mt19937&) = {rounded_box, slice,   silo,
                                                                         bent_pipe,   capsule, gutter};
  std::vector<Face> faces = kMake[family](random);
  if (random() % 2 == 0) {
    std::shuffle(faces.begin(), faces.end(), random);
    faces.resize(std::max<std::size_t>(1, faces.size() * 4 / 5));
  }
  const double angle = between(random, 0.0, 6.0);
  const Eigen::AngleAxisd turn(angle, random_direction(random));
  for (Face& face : faces)
    for (Vector3* x : {&face.frame.origin, &face.frame.x, &face.frame.y, &face.frame.z}) *x = turn * *x;
  return faces;
}

Vector3 random_point(std::mt19937& random, const std::vector<Face>& faces, int place) {
  const Face& face = faces[random() % faces.size()];
  Parameter<2> xi;
  const bool corner = place == 2 || place == 4, side = place != 0;
  const unsigned along = random() % 2;
  for (unsigned i = 0; i < 2; ++i) {
    const double share = between(random, 0.0, 1.0), end = random() % 2 == 0 ? 0.0 : 1.0;
    const double s = corner || (side && i == along) ? end : share;
    xi[i] = face.low[i] + s * (face.high[i] - face.low[i]);
  }
  const Vector3 p = point_on(face, xi[0], xi[1]), off = random_direction(random),
                n = tangents_on(face, xi).first.cross(tangents_on(face, xi).second);
  const double h = between(random, -0.5, 0.5);
  if (place <= 2) return p + h * off;
  return p + h * n + (place == 5 ? between(random, -1e-3, 1e-3) : 0.0) * off;
}

}  // namespace brep::trials

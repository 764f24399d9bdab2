// SPDX-License-Identifier: GPL-2.0-or-later
// Fields of contacts on a surface: their integrals are the totals, on any number of ranks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "brep/builder.h"
#include "coupling/face_fields.h"
#include "coupling/finnie.h"
#include "coupling/surface_fields.h"
#include "nurbs/control_area.h"
#include "nurbs/primitives.h"
#include "wavy_surface.h"

namespace {

using coupling::SurfaceContact;
using coupling::SurfaceFields;
using coupling::Vector3;
using nurbs::KnotVector;
using nurbs::Surface;

const coupling::RigidFrame kAtRest;
constexpr SurfaceFields::Selection kAll{true, true, true, true};

int rank_of(int tag) {
  int count;
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  return tag % count;
}
int my_rank() {
  int me;
  MPI_Comm_rank(MPI_COMM_WORLD, &me);
  return me;
}

/// A sphere and beside it a wavy patch: rational and polynomial, closed and open, with poles.
nurbs::PatchedSurface surface() {
  const nurbs::Curve turn = nurbs::refined(nurbs::arc(0, 360), 8, 2),
                     half = nurbs::refined(nurbs::arc(-90, 90), 4, 2);
  return nurbs::join({nurbs::sphere(nurbs::frame(Vector3(3, 0, 0), Vector3(0, 0, 1)), 1.0, turn, half),
                      test::wavy_surface()});
}

SurfaceFields start(const nurbs::PatchedSurface& s) {
  return SurfaceFields(MPI_COMM_WORLD, s.topology, s.control_points);
}

SurfaceContact contact_of(int tag) {
  const double t = tag;
  Vector3 normal(std::sin(t), std::cos(2 * t), 1.5);
  normal.normalize();
  return {{tag % 2, {std::fmod(0.37 * t, 1.0), std::fmod(0.73 * t, 1.0)}},
          {std::sin(3 * t), 2.0, -t},
          normal,
          1e-9 * t};
}

void add_all(SurfaceFields& fields, int particles) {
  fields.begin_sample();
  for (int tag = 1; tag <= particles; ++tag)
    if (rank_of(tag) == my_rank()) fields.add(contact_of(tag));
}

const Eigen::MatrixXd& field(const vtk::PatchFields<2>& patch, const std::string& name) {
  for (const auto* list : {&patch.control_points, &patch.elements})
    for (const vtk::Field& f : *list)
      if (f.name == name) return f.values;
  throw std::invalid_argument("no field " + name);
}

/// Integral of a control-point field over all patches.
Eigen::VectorXd integral(const std::vector<vtk::PatchFields<2>>& fields, const std::string& name) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(field(fields[0], name).rows());
  for (const vtk::PatchFields<2>& p : fields)
    sum += field(p, name) * nurbs::control_point_areas(p.patch.space, p.patch.control_points);
  return sum;
}

TEST(SurfaceFields, IntegrateToTheTotals) {
  SurfaceFields fields = start(surface());
  const int particles = 50;
  add_all(fields, particles);
  const auto result = fields.fields(surface().control_points, kAtRest, kAll);
  if (my_rank() != 0) return;

  double normal = 0.0, worn = 0.0;
  Vector3 shear = Vector3::Zero();
  for (int tag = 1; tag <= particles; ++tag) {
    const SurfaceContact c = contact_of(tag);
    normal -= c.force.dot(c.normal);
    shear += c.force - c.force.dot(c.normal) * c.normal;
    worn += c.worn_volume;
  }
  EXPECT_NEAR(integral(result, "pressure")[0], normal, 1e-12 * std::abs(normal));
  EXPECT_LE((integral(result, "shear") - shear).norm(), 1e-12 * shear.norm());
  EXPECT_NEAR(integral(result, "wear")[0], worn, 1e-12 * worn);
}

TEST(SurfaceFields, CountTheContactsOfEachElement) {
  SurfaceFields fields = start(surface());
  const int particles = 50;
  add_all(fields, particles);
  const auto result = fields.fields(surface().control_points, kAtRest, kAll);
  if (my_rank() != 0) return;
  for (int patch = 0; patch < 2; ++patch) {
    const nurbs::Space<2>& space = result[patch].patch.space;
    const auto element_along = [&](int i, double xi) {
      const std::vector<double>& breaks = space.knots(i).breaks();
      return static_cast<int>(std::upper_bound(breaks.begin(), breaks.end(), xi) - breaks.begin()) - 1;
    };
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(1, space.element_count());
    for (int tag = 1; tag <= particles; ++tag) {
      const nurbs::SurfacePoint at = contact_of(tag).foot;
      if (at.patch == patch)
        expected(space.element_index({element_along(0, at.xi[0]), element_along(1, at.xi[1])})) += 1.0;
    }
    EXPECT_EQ(expected.sum(), particles / 2);
    EXPECT_EQ(field(result[patch], "contact_count"), expected) << "patch " << patch;
  }
}

TEST(SurfaceFields, AnEvenLoadIsAnEvenPressure) {
  const std::array<KnotVector, 2> knots{KnotVector::uniform(2, 4), KnotVector::uniform(3, 3)};
  const nurbs::PatchedSurface floor = nurbs::join({nurbs::plane({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, knots)});
  SurfaceFields fields = start(floor);
  fields.begin_sample();
  const int n = 400;
  for (int k = 0; k < n * n; ++k)
    if (rank_of(k) == my_rank())
      fields.add({{0, {(k % n + 0.5) / n, (k / n + 0.5) / n}}, {0.5, 0, -3.0}, {0, 0, 1}, 0.0});
  const auto result = fields.fields(floor.control_points, kAtRest, kAll);
  if (my_rank() != 0) return;
  const Eigen::MatrixXd &p = field(result[0], "pressure"), &t = field(result[0], "shear");
  const double expected = 3.0 * n * n / 2.0;  // force per area
  EXPECT_LE((p.array() / expected - 1.0).abs().maxCoeff(), 1e-3);
  EXPECT_LE((t.row(0).array() / (expected / 6.0) - 1.0).abs().maxCoeff(), 1e-3);
  EXPECT_LE(t.bottomRows(2).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(SurfaceFields, AreMeansOverTheInterval) {
  SurfaceFields fields = start(surface());
  add_all(fields, 10);
  const auto one = fields.fields(surface().control_points, kAtRest, kAll);
  fields.begin_sample();  // a step without contacts
  const auto two = fields.fields(surface().control_points, kAtRest, kAll);
  fields.begin_interval();
  fields.begin_sample();
  const auto none = fields.fields(surface().control_points, kAtRest, kAll);
  fields.begin_interval();
  add_all(fields, 10);
  const auto again = fields.fields(surface().control_points, kAtRest, kAll);
  if (my_rank() != 0) return;
  for (const char* name : {"pressure", "shear", "contact_count"}) {
    EXPECT_EQ(field(two[0], name), 0.5 * field(one[0], name)) << name;
    EXPECT_EQ(field(again[0], name), field(one[0], name)) << name;
    EXPECT_TRUE(field(none[0], name).isZero(0.0)) << name;
  }
  EXPECT_EQ(field(none[0], "wear"), field(one[0], "wear")) << "wear stays";
}

TEST(SurfaceFields, AreOneAtSeamsAndPoles) {
  SurfaceFields fields = start(surface());
  fields.begin_sample();
  if (my_rank() == 0) {
    fields.add({{0, {0.0, 0.4}}, {0, 0, -1}, {0, 0, 1}, 0.0});  // at the seam, reported on one side of it
    fields.add({{0, {0.3, 1.0}}, {0, 0, -1}, {0, 0, 1}, 0.0});  // at a pole
  }
  const auto result = fields.fields(surface().control_points, kAtRest, kAll);
  if (my_rank() != 0) return;
  const Eigen::MatrixXd& p = field(result[0], "pressure");
  const int n = result[0].patch.space.control_point_count(0),
            m = result[0].patch.space.control_point_count(1);
  double seam = 0.0;
  for (int j = 0; j < m; ++j) {
    EXPECT_EQ(p(0, n * j), p(0, n * j + n - 1));
    seam = std::max(seam, p(0, n * j));
  }
  EXPECT_GT(seam, 0.0);
  for (int i = 0; i < n; ++i) EXPECT_EQ(p(0, n * (m - 1) + i), p(0, n * (m - 1)));
  EXPECT_GT(p(0, n * (m - 1)), 0.0);
  EXPECT_NEAR(integral(result, "pressure")[0], 2.0, 1e-12);
}

TEST(SurfaceFields, MoveWithTheWall) {
  SurfaceFields fields = start(surface());
  add_all(fields, 10);
  coupling::RigidFrame turned_frame;
  turned_frame.rotation = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  turned_frame.origin = Vector3(4, 5, 6);
  const Eigen::Matrix3d& turn = turned_frame.rotation;
  const auto still = fields.fields(surface().control_points, kAtRest, kAll),
             turned = fields.fields(surface().control_points, turned_frame, kAll);
  if (my_rank() != 0) return;
  EXPECT_LE((field(turned[1], "shear") - turn * field(still[1], "shear")).norm(),
            1e-12 * field(still[1], "shear").norm());
  EXPECT_EQ(field(turned[1], "pressure"), field(still[1], "pressure"));
  for (int a = 0; a < still[1].patch.control_points.cols(); ++a)
    EXPECT_EQ(Vector3(turned[1].patch.control_points.col(a)),
              turned_frame.to_space(still[1].patch.control_points.col(a)));
}

TEST(SurfaceFields, ComeBackFromARestart) {
  SurfaceFields before = start(surface()), after = start(surface());
  add_all(before, 20);
  std::vector<double> state = before.save();
  int size = static_cast<int>(state.size());
  MPI_Bcast(state.data(), size, MPI_DOUBLE, 0, MPI_COMM_WORLD);  // as LIGGGHTS hands it to every rank
  after.load(state);
  const auto expected = before.fields(surface().control_points, kAtRest, kAll),
             got = after.fields(surface().control_points, kAtRest, kAll);
  for (const char* name : {"pressure", "shear", "contact_count", "wear"})
    if (my_rank() == 0) {
      EXPECT_EQ(field(got[1], name), field(expected[1], name)) << name;
    }
  after.begin_interval();
  after.begin_sample();
  const auto none = after.fields(surface().control_points, kAtRest, kAll);
  for (const char* name : {"pressure", "shear", "contact_count"})
    if (my_rank() == 0) {
      EXPECT_TRUE(field(none[1], name).isZero(0.0)) << name;
    }
  state.pop_back();
  EXPECT_THAT([&] { after.load(state); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("expected")));
}

TEST(SurfaceFields, AreForcesPerAreaOfTheDeformedSurface) {
  SurfaceFields fields = start(surface());
  add_all(fields, 10);
  const auto before = fields.fields(surface().control_points, kAtRest, kAll),
             stretched = fields.fields(2.0 * surface().control_points, kAtRest, kAll);
  if (my_rank() != 0) return;
  const Eigen::MatrixXd &p = field(before[1], "pressure"), &q = field(stretched[1], "pressure");
  EXPECT_LE((4.0 * q - p).norm(), 1e-13 * p.norm());
}

TEST(SurfaceFields, AreThoseAskedFor) {
  SurfaceFields fields = start(surface());
  const auto result = fields.fields(surface().control_points, kAtRest, {false, true, false, true});
  ASSERT_EQ(result[0].control_points.size(), 2u);
  EXPECT_EQ(result[0].control_points[0].name, "shear");
  EXPECT_EQ(result[0].control_points[1].name, "wear");
  EXPECT_TRUE(result[0].elements.empty());
}

/// A square of n x n x 2 triangles in one plane and a wall on one of its sides.
std::shared_ptr<const brep::Surface> square_and_wall(int n) {
  nurbs::NodalVectors points(3, (n + 1) * (n + 2));
  std::vector<int> corners;
  for (int j = 0; j <= n + 1; ++j)
    for (int i = 0; i <= n; ++i) points.col(i + (n + 1) * j) << i, std::min(j, n), j > n ? 1.0 : 0.0;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = i + (n + 1) * j, b = a + n + 1;
      corners.insert(corners.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  return std::make_shared<brep::Surface>(brep::from_triangles(points, corners));
}

// One force of its own in each triangle: at the middle of cell (i, j) moved off the diagonal.
void expect_fields_of_each_triangle(int n) {
  const auto wall = square_and_wall(n);
  coupling::FaceFields fields(MPI_COMM_WORLD, wall);
  fields.begin_sample();
  int tag = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      for (const double off : {-0.2, 0.2}) {
        const Vector3 at(i + 0.5 - off, j + 0.5 + off, 0.0);
        const brep::Frame& plane = wall->faces[0].frame;
        const Vector3 from = at - plane.origin;
        SurfaceContact c{{0, {from.dot(plane.x), from.dot(plane.y)}}, {1.0, 0, 0}, {0, 0, 1}, 0.0};
        c.force[2] = -(i + 10.0 * j) - (off > 0.0 ? 0.5 : 0.0);
        c.worn_volume = 2.0 * at[0];
        if (rank_of(++tag) == my_rank()) fields.add(c);
      }
  ASSERT_EQ(wall->faces[0].piece_count, 2 * n * n);
  const auto state = std::get<vtk::TriangleFields>(fields.state({}, kAtRest, kAll));
  if (my_rank() != 0) return;
  for (std::size_t t = 0; t < state.mesh.triangles.size(); ++t) {
    Vector3 middle = Vector3::Zero();
    for (const int v : state.mesh.triangles[t]) middle += state.mesh.vertices.col(v) / 3.0;
    const double i = std::floor(middle[0]), j = std::floor(middle[1]), x = middle[0] - i, y = middle[1] - j;
    const bool floor = middle[2] == 0.0;
    const auto value = [&](int field, int row) { return state.cells[field].values(row, t); };
    EXPECT_NEAR(value(0, 0), floor ? 2.0 * (i + 10.0 * j + (y > x ? 0.5 : 0.0)) : 0.0, 1e-12);
    EXPECT_NEAR(value(1, 0), floor ? 2.0 : 0.0, 1e-12);
    EXPECT_NEAR(value(2, 0), floor ? 4.0 * (i + 0.5 + (y > x ? -0.2 : 0.2)) : 0.0, 1e-12);
    EXPECT_EQ(value(3, 0), floor ? 1.0 : 0.0);
  }
  EXPECT_EQ(state.cells[1].name, "shear");
  EXPECT_EQ(state.cells[3].name, "contact_count");
}

TEST(FaceFields, BelongToTheTriangleThatTheFootIsIn) { expect_fields_of_each_triangle(4); }
TEST(FaceFields, BelongToThatOneOfMany) { expect_fields_of_each_triangle(12); }

// On a side that two share one of them has it; beyond the rim by round-off that at the rim.
TEST(FaceFields, BelongToOneTriangleOnSides) {
  for (const int n : {4, 12}) {
    const auto wall = square_and_wall(n);
    const brep::Frame& plane = wall->faces[0].frame;
    coupling::FaceFields fields(MPI_COMM_SELF, wall);
    fields.begin_sample();
    for (const Vector3& at : {Vector3(0.5, -1e-12, 0.0), Vector3(1.5, 1.5, 0.0), Vector3(2.0, 1.25, 0.0)}) {
      const Vector3 from = at - plane.origin;
      fields.add({{0, {from.dot(plane.x), from.dot(plane.y)}}, {0, 0, -1.0}, {0, 0, 1}, 0.0});
    }
    const auto state = std::get<vtk::TriangleFields>(fields.state({}, kAtRest, kAll));
    const auto contacts = [&](int triangle) { return state.cells[3].values(0, triangle); };
    const int below = 2 * (1 + n), above = below + 1, beside = 2 * (2 + n) + 1;  // in cells (1, 1) and (2, 1)
    EXPECT_EQ(contacts(0), 1.0) << n;
    EXPECT_EQ(contacts(below) + contacts(above) + contacts(beside), 2.0) << n;
    EXPECT_EQ(state.cells[3].values.sum(), 3.0) << n;
  }
}

TEST(Finnie, HasTheFormulasOfBothRegimes) {
  const double k = 2e-12, speed = 3.0, force = 5.0, pi = std::acos(-1.0);
  const Vector3 normal(0, 0, 1);
  const auto rate = [&](double degrees) {
    const double gamma = degrees * pi / 180.0;
    return coupling::finnie_wear_rate(speed * Vector3(std::cos(gamma), 0, -std::sin(gamma)), normal, force,
                                      k) /
           (2.0 * k * speed * force);
  };
  for (double degrees : {0.0, 5.0, 15.0, 18.0}) {
    const double gamma = degrees * pi / 180.0;
    EXPECT_NEAR(rate(degrees), std::sin(2 * gamma) - 3 * std::pow(std::sin(gamma), 2), 1e-14) << degrees;
  }
  for (double degrees : {19.0, 45.0, 60.0, 90.0})
    EXPECT_NEAR(rate(degrees), std::pow(std::cos(degrees * pi / 180.0), 2) / 3, 1e-14) << degrees;
  const double border = std::atan(1.0 / 3.0) * 180.0 / pi;
  EXPECT_NEAR(rate(border - 1e-9), 0.3, 1e-9)
      << "cos^2(gamma) / 3 = 0.3 where tan(gamma) = 1/3, from both sides";
  EXPECT_NEAR(rate(border + 1e-9), 0.3, 1e-9);
  EXPECT_EQ(rate(-10.0), 0.0) << "moving away";
  EXPECT_EQ(coupling::finnie_wear_rate(Vector3::Zero(), normal, force, k), 0.0);
}

}  // namespace

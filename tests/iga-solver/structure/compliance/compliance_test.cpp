// SPDX-License-Identifier: GPL-2.0-or-later
// Local compliances of meshes.  What a mesh gives way at a foot less its local compliance is the body's Green
// function less the half-space's, so it must be the same on all meshes; on cubes the numbers are those of a
// mesh without end.
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "models.h"
#include "nurbs/primitives.h"
#include "nurbs/refinement.h"
#include "point_force.h"
#include "structure/compliance/compliance_tables.h"
#include "structure/compliance/flat_elements.h"
#include "structure/weld.h"
#include "top.h"

namespace {

using models::Matrix3;
using models::NodalVectors;
using models::Vector3;
using nurbs::KnotVector;
using nurbs::Volume;
using point_force::block_body;
using point_force::body_of;
using point_force::kNu;
using point_force::kTop;
using point_force::mesh_compliance;
using structure::ComplianceTable;
using structure::ComplianceTables;
using structure::Quadrature;
using structure::ReferenceBody;
using testing::HasSubstr;
using testing::ThrowsMessage;
using top::Top;

TEST(GradientProducts, IntegratesAnElementOnceWhilePatchesHaveIt) {
  const ReferenceBody body = block_body({3, 3, 3}, {3, 3, 3}, 2);
  structure::GradientProducts gradients(body);
  for (int patch = 0; patch < 3; ++patch) {
    gradients.begin_patch();
    gradients.of({0, 7});
    if (patch == 0) gradients.of({0, 8});
  }
  EXPECT_EQ(gradients.integrated(), 2);
  gradients.begin_patch();
  gradients.of({0, 8});  // forgotten
  EXPECT_EQ(gradients.integrated(), 3);
}

// c E' h of cubes without end, from patches of ever more layers: 0.804, 0.997 and 1.274 (7 layers); 1.302,
// 1.055 and 0.875 (5 layers).
TEST(Compliance, OfCubesIsThatOfAMeshWithoutEnd) {
  const std::pair<int, std::array<double, 3>> cases[] = {{2, {0.8043, 0.9968, 1.2741}},
                                                         {3, {1.3024, 1.0553, 0.8751}}};
  for (const auto& [degree, expected] : cases) {
    const Top top{block_body({18, 18, 8}, {18, 18, 8}, degree)};
    ComplianceTables tables(top.body, kTop);
    const double E_plane = 1.0 / (1.0 - kNu * kNu), h = 1.0 / 18;
    EXPECT_NEAR(E_plane * top.table(tables, {0.5, 0.5}), expected[0], 0.007 * expected[0]);
    EXPECT_NEAR(E_plane * top.table(tables, {0.5 + 0.5 * h, 0.5}), expected[1], 0.007 * expected[1]);
    EXPECT_NEAR(E_plane * top.table(tables, {0.5 + 0.5 * h, 0.5 + 0.5 * h}), expected[2],
                0.007 * expected[2]);
    EXPECT_NEAR(top.table(tables, {0.5, 0.5}, ComplianceTable::first),
                top.table(tables, {0.5, 0.5}, ComplianceTable::second), 1e-9);
  }
}

struct Place {
  const char* where;
  double x, y, tolerance;
};

// A cube of 6 on a rigid base: what is left of the mesh's answer must not depend on the mesh, however near to
// an edge or a corner.
TEST(Compliance, LeavesTheBodyWhatIsItsOwn) {
  const double size = 6.0;
  const auto on_base = [](const Vector3& X) { return X[2] < 1e-9; };
  const Place places[] = {{"corner of elements", 3, 3, 0.04},
                          {"centre of an element", 2.5, 2.5, 0.04},
                          {"1 from an edge", 1, 3, 0.03},
                          {"1/2 from an edge", 0.5, 3, 0.06},
                          {"1/2 from a corner", 0.5, 0.5, 0.04}};
  for (const Place& place : places) {
    std::vector<double> left;
    for (const auto& [degree, elements, quadrature] : {std::tuple{2, 6, Quadrature::full},
                                                       {2, 12, Quadrature::full},
                                                       {2, 6, Quadrature::reduced},
                                                       {2, 12, Quadrature::reduced},
                                                       {3, 6, Quadrature::full}}) {
      const ReferenceBody body =
          block_body({size, size, 4}, {elements, elements, elements * 2 / 3}, degree, quadrature);
      const Top top{body};
      const nurbs::Parameter<2> xi = {place.x / size, place.y / size};
      ComplianceTables tables(body, kTop);
      const double c = tables.direct(0, top.element(xi), xi)(2, 2);
      left.push_back(mesh_compliance(body, xi, on_base) - c);
      EXPECT_GT(c, 0.7);
    }
    EXPECT_LT(*std::max_element(left.begin(), left.end()) - *std::min_element(left.begin(), left.end()),
              place.tolerance)
        << place.where << ": " << testing::PrintToString(left);
  }
}

// Bending of a thin plate stays in the mesh.
TEST(Compliance, LeavesAPlateItsBending) {
  const auto on_sides = [](const Vector3& X) { return std::min({X[0], X[1], 8 - X[0], 8 - X[1]}) < 1e-9; };
  std::vector<double> left, of_mesh;
  for (const int layers : {2, 3, 4}) {
    const ReferenceBody body = block_body({8, 8, 1}, {8 * layers, 8 * layers, layers}, 2);
    const Top top{body};
    ComplianceTables tables(body, kTop);
    of_mesh.push_back(mesh_compliance(body, {0.5, 0.5}, on_sides));
    left.push_back(of_mesh.back() - top.table(tables, {0.5, 0.5}));
  }
  EXPECT_NEAR(left[0], left[2], 0.04) << testing::PrintToString(left);  // the mesh bends by so much less
  EXPECT_NEAR(left[1], left[2], 0.011);
  EXPECT_GT(of_mesh[2] - of_mesh[0], 1.5);
}

// The same on a quarter of a tube, rational, from outside and from inside: what is left is small there beside
// c.
TEST(Compliance, LeavesACurvedBodyWhatIsItsOwn) {
  const auto on_ends = [](const Vector3& X) { return std::min(X[0], X[1]) < 1e-9; };
  for (const nurbs::Face face : {nurbs::Face::xi_plus, nurbs::Face::xi_minus})
    for (const double y : {0.5, 0.5 + 1.0 / 12}) {
      std::vector<double> left;
      double largest = 0.0;
      for (const auto& [degree, elements] : {std::pair{2, 6}, {2, 12}, {3, 6}}) {
        const ReferenceBody body = body_of(models::quarter_ring(degree, elements));
        const nurbs::Space<2> space = nurbs::boundary_surface(body.patches[0].space, face).space;
        ComplianceTables tables(body, {{0, face}});
        const nurbs::Parameter<2> xi = {0.5, y};
        const int element = space.element_at(xi);
        const Vector3 n = structure::FaceSurface(body, {0, face}).at(element, xi).outward_normal;
        const double c = n.dot(tables.direct(0, element, xi) * n);
        left.push_back(mesh_compliance(body, xi, on_ends, {0, face}) - c);
        largest = std::max(largest, c);
      }
      EXPECT_LT(*std::max_element(left.begin(), left.end()) - *std::min_element(left.begin(), left.end()),
                0.08)
          << testing::PrintToString(left) << " y " << y;
      EXPECT_GT(largest, 4.0);
    }
}

// Far from the ends, where its neighbours see the same.
TEST(Compliance, ATableHoldsWhatAnyPointOfItsElementHas) {
  for (const int degree : {2, 3})
    for (const int layers : {1, 6}) {
      const Top top{block_body({20, 20, double(layers)}, {20, 20, layers}, degree)};
      ComplianceTables tables(top.body, kTop);
      const double tolerance = layers == 1 ? 5e-4 : 1e-7;
      for (const nurbs::Parameter<2> xi : {nurbs::Parameter<2>{0.51, 0.54}, {0.525, 0.506}}) {
        const Matrix3 c = tables.direct(0, top.element(xi), xi);
        EXPECT_NEAR(top.table(tables, xi), c(2, 2), tolerance * c(2, 2));
        EXPECT_NEAR(top.table(tables, xi, ComplianceTable::first), c(0, 0), tolerance * c(0, 0));
        EXPECT_NEAR(top.table(tables, xi, ComplianceTable::second), c(1, 1), tolerance * c(1, 1));
        const double step = 1e-5;
        for (int d = 0; d < 2; ++d) {
          nurbs::Parameter<2> before = xi, after = xi;
          before[d] -= step;
          after[d] += step;
          EXPECT_NEAR(top.value(tables, xi).change[d],
                      (top.table(tables, after) - top.table(tables, before)) / (2.0 * step), 1e-5);
        }
      }
    }
}

// Runs give the same digits on all machines: beside sums of powers, of degrees 2, 3 and both.
TEST(TableKernel, InstructionSetsAgreeInAllDigits) {
  using structure::FourPolynomials;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const auto& [in_s, in_t] : {std::pair(5, 5), {7, 7}, {5, 7}}) {
    std::vector<double> coefficients(FourPolynomials::kCount * in_s * in_t);
    for (double& c : coefficients) c = uniform(random);
    const double s = uniform(random), t = uniform(random);
    FourPolynomials portable;
    structure::table_kernel(nurbs::SimdLevel::portable)(coefficients.data(), in_s, in_t, s, t, portable);
    for (int k = 0; k < FourPolynomials::kCount; ++k) {
      double value = 0.0, by_s = 0.0, by_t = 0.0;
      for (int j = 0; j < in_t; ++j)
        for (int i = 0; i < in_s; ++i) {
          const double c = coefficients[k + FourPolynomials::kCount * (i + in_s * j)];
          value += c * std::pow(s, i) * std::pow(t, j);
          if (i > 0) by_s += c * i * std::pow(s, i - 1) * std::pow(t, j);
          if (j > 0) by_t += c * j * std::pow(s, i) * std::pow(t, j - 1);
        }
      EXPECT_NEAR(portable.value[k], value, 1e-13);
      EXPECT_NEAR(portable.by_s[k], by_s, 1e-12);
      EXPECT_NEAR(portable.by_t[k], by_t, 1e-12);
    }
    for (const nurbs::SimdLevel level : {nurbs::SimdLevel::avx2, nurbs::SimdLevel::avx512}) {
      if (!nurbs::available(level)) continue;
      FourPolynomials found;
      structure::table_kernel(level)(coefficients.data(), in_s, in_t, s, t, found);
      for (int k = 0; k < FourPolynomials::kCount; ++k) {
        EXPECT_EQ(found.value[k], portable.value[k]);
        EXPECT_EQ(found.by_s[k], portable.by_s[k]);
        EXPECT_EQ(found.by_t[k], portable.by_t[k]);
      }
    }
  }
}

TEST(Compliance, IsThatOfTheBodyWhereverItStandsAndInAnyUnits) {
  const Volume patch = models::distorted(models::block({9, 9, 4}, {9, 9, 4}, 2), 0.1);
  const Top top{body_of(patch)};
  ComplianceTables tables(top.body, kTop);
  Volume moved = patch;
  const Matrix3 turn = nurbs::frame(Vector3::Zero(), Vector3(1, 2, 3), Vector3(1, 0, 0)).axes;
  moved.control_points = (0.5 * turn * patch.control_points).colwise() + Vector3(10, 20, 30);
  ComplianceTables of_moved(body_of(moved, 4.0), kTop);
  for (const auto component :
       {ComplianceTable::normal, ComplianceTable::first, ComplianceTable::first_normal}) {
    const double c = top.table(tables, {0.53, 0.47}, component);
    EXPECT_NEAR(top.table(of_moved, {0.53, 0.47}, component), 0.5 * c, 1e-9);
  }
}

// 7 x 7 x 4 elements are all that take part: nothing is held, springs do.
TEST(Compliance, OfAWholeBodyIsThatOfAPieceOfALargerOne) {
  const Top small{block_body({7, 7, 4}, {7, 7, 4}, 2)}, large{block_body({15, 15, 8}, {15, 15, 8}, 2)};
  ComplianceTables of_small(small.body, kTop), of_large(large.body, kTop);
  for (const double x : {0.0, 0.5})
    EXPECT_NEAR(small.table(of_small, {(3 + x) / 7, 3.5 / 7}),
                large.table(of_large, {(7 + x) / 15, 7.5 / 15}), 0.008 * 1.2);
}

// Cubes of a few elements, held at their bases: feet are where springs' rest would be infinite.
TEST(Compliance, OfAFewElementsLeavesWhatAFinerMeshDoes) {
  const double plane_modulus = 1.0 / (1.0 - kNu * kNu);
  for (const auto& [n, place] : {std::pair{std::array<int, 3>{3, 3, 1}, 0.5},
                                 {{3, 3, 3}, 0.5},
                                 {{3, 3, 3}, 0.75},
                                 {{2, 2, 2}, 0.5},
                                 {{2, 2, 2}, 0.75}}) {
    std::vector<double> left;
    for (const int finer : {1, 2, 4}) {
      const Top top{block_body(Vector3(n[0], n[1], n[2]), {finer * n[0], finer * n[1], finer * n[2]}, 2)};
      ComplianceTables tables(top.body, kTop);
      const nurbs::Parameter<2> xi = {place, place};
      const auto on_base = [](const Vector3& X) { return X[2] < 1e-9; };
      const double c = tables.direct(0, top.element(xi), xi)(2, 2);
      EXPECT_TRUE(std::isfinite(top.table(tables, xi)));
      left.push_back(plane_modulus * (mesh_compliance(top.body, xi, on_base) - c));
    }
    EXPECT_NEAR(left[0], left[2], 0.036) << n[0] << ' ' << n[2] << ' ' << place;
    EXPECT_NEAR(left[1], left[2], 0.021) << n[0] << ' ' << n[2] << ' ' << place;
  }
}

TEST(Compliance, OfASingleElementIsRefused) {
  EXPECT_THAT(
      [] {
        ComplianceTables(block_body({1, 1, 1}, {1, 1, 1}, 2), kTop);
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("given a single one")));
}

TEST(Compliance, GoesAcrossWelds) {
  const KnotVector whole(2, {0, 0, 0, 1, 2, 3, 3, 4, 5, 6, 6, 6}),
      half = KnotVector::uniform(2, 3, 0, 3), y = KnotVector::uniform(2, 6), z = KnotVector::uniform(2, 4);
  const Top one{body_of(nurbs::box(Vector3::Zero(), {6, 6, 4}, {whole, y, z}))};
  const std::vector<Volume> halves = {nurbs::box(Vector3::Zero(), {3, 6, 4}, {half, y, z}),
                                      nurbs::box({3, 0, 0}, {3, 6, 4}, {half, y, z})};
  ComplianceTables tables(one.body, kTop);
  ComplianceTables of_halves(
      {halves, {models::elastic(1.0, kNu), models::elastic(1.0, kNu)}, structure::weld(halves)},
      {{0, nurbs::Face::zeta_plus}, {1, nurbs::Face::zeta_plus}});
  const nurbs::Parameter<2> xi = {2.6, 0.55};  // in the element beside the weld
  EXPECT_NEAR((of_halves.direct(0, 2 + 3 * 3, xi) - tables.direct(0, 2 + 6 * 3, xi)).norm(), 0.0, 1e-10);
}

TEST(Compliance, ElementsThatSeeTheSameShareATable) {
  const Top top{block_body({20, 20, 6}, {20, 20, 6}, 2)};
  ComplianceTables tables(top.body, kTop);
  const ComplianceTable* const one = &tables.of(0, 11 + 20 * 12);
  for (int j = 7; j < 13; ++j)
    for (int i = 7; i < 13; ++i) EXPECT_EQ(&tables.of(0, i + 20 * j), one);
  EXPECT_EQ(tables.solved(), 1);
  EXPECT_NE(&tables.of(0, 3 + 20 * 12), one);  // an edge comes into reach
  EXPECT_EQ(tables.solved(), 5);               // 1, 2 and 4, too
}

// A graded mesh has elements of one size with others of several sizes beside them.  Where it is not affine
// every element has a table of its own.
TEST(Compliance, ASharedTableIsThatOfTheElementItself) {
  std::vector<double> breaks{0};
  for (int e = 0; e < 40; ++e) breaks.push_back(breaks.back() + (e < 9 ? 1.5 : e < 26 ? 1.0 : 0.8));
  const KnotVector x = KnotVector::from_breaks(2, breaks), y = KnotVector::uniform(2, 16, 0, 16),
                   z = KnotVector::uniform(2, 4, 0, 4);
  const Volume box = nurbs::box(Vector3::Zero(), {breaks.back(), 16, 4}, {x, y, z});
  const Top top{body_of(box)}, other{body_of(models::distorted(box, 1e-8))};
  ComplianceTables tables(top.body, kTop), unshared(other.body, kTop);
  for (int e = 9; e < 29; e += 2)
    for (const double way : {0.0, 0.02, 0.3}) {
      const nurbs::Parameter<2> xi = {breaks[e] + way * (breaks[e + 1] - breaks[e]), 8.5};
      const double own = top.table(unshared, xi);
      EXPECT_NEAR(top.table(tables, xi), own, 2e-6 * own) << e;
    }
  EXPECT_LT(4 * tables.solved(), unshared.solved());
}

TEST(Compliance, RefusesWhatItDoesNotKnow) {
  const Volume patch = models::block({3, 3, 3}, {3, 3, 3}, 2);
  const auto of_law = [&](std::shared_ptr<const structure::Material> law) {
    return [=] { ComplianceTables({{patch}, {law}, structure::without_welds({patch})}, kTop); };
  };
  for (const structure::MaterialLaw& law : structure::material_laws()) {
    if (law.word == std::string("orthotropic_elastic"))
      EXPECT_THAT(of_law(models::make_law(law)),
                  ThrowsMessage<std::invalid_argument>(HasSubstr("given 'orthotropic_elastic'")));
    else
      EXPECT_NO_THROW(of_law(models::make_law(law))());
  }
  const Volume quartic = models::block({5, 5, 5}, {5, 5, 5}, 4);
  EXPECT_THAT([&] { ComplianceTables(body_of(quartic), kTop); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("degrees 2 and 3, given 4, 4, 4")));
  EXPECT_THAT([&] { ComplianceTables(body_of(patch, 1.0, Quadrature::zou), kTop); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("given 'zou'")));
  const structure::ReferenceBody flat = block_body({40, 40, 2}, {9, 9, 170}, 2);
  EXPECT_THAT([&] { ComplianceTables(flat, kTop).of(0, 4 + 9 * 4); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("too flat")));
  EXPECT_THAT([&] { structure::expect_no_flat_elements(flat, kTop); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("too flat")));
}

// Which no table has to be asked for.
TEST(Compliance, SaysBeforehandHowManyUnknownsTakePart) {
  const Vector3 size(8.0, 6.0, 3.0);
  for (const int degree : {2, 3})
    for (const nurbs::Indices<3>& elements :
         {nurbs::Indices<3>{8, 6, 3}, {16, 12, 1}, {32, 24, 1}, {12, 30, 2}, {4, 3, 12}, {9, 2, 1}}) {
      const structure::ReferenceBody body = block_body(size, elements, degree);
      const structure::NearElements near(body);
      const nurbs::Space<3>& space = body.patches[0].space;
      const structure::LocalExtent extent = structure::extent_for(space);
      for (const nurbs::Indices<3>& at :
           {nurbs::Indices<3>{elements[0] / 2, elements[1] / 2, elements[2] - 1},
            {0, elements[1] / 3, elements[2] - 1}}) {
        const int element = space.element_index(at);
        const double there = 3.0 * structure::LocalPatch(body, near, {0, element}, extent).free_count();
        const double about = structure::unknowns_about(body.patches[0], element, extent);
        EXPECT_GT(about, 0.85 * there) << degree << " " << elements[0] << " " << elements[1];
        EXPECT_LT(about, 1.4 * there) << degree << " " << elements[0] << " " << elements[1];
      }
    }
  EXPECT_NO_THROW(structure::expect_no_flat_elements(block_body(size, {8, 6, 3}, 2), kTop));
}

}  // namespace

// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/basis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nurbs/patch.h"
#include "nurbs/shapes.h"

namespace nurbs {
namespace {

// Cox-de Boor by its recursion, 0/0 := 0, straight from the formula (Piegl & Tiller 1997, eq. 2.5).  With
// `misprint` the second numerator is that of Gao & Feng (2019), eq. 2.
double cox_de_boor(const std::vector<double>& U, int i, int p, double xi, bool misprint = false) {
  if (p == 0) return U[i] <= xi && xi < U[i + 1] ? 1.0 : 0.0;
  double N = 0.0;
  if (U[i + p] > U[i]) N += (xi - U[i]) / (U[i + p] - U[i]) * cox_de_boor(U, i, p - 1, xi, misprint);
  if (U[i + p + 1] > U[i + 1]) {
    const double numerator = misprint ? U[i + p + 1] - U[i] : U[i + p + 1] - xi;
    N += numerator / (U[i + p + 1] - U[i + 1]) * cox_de_boor(U, i + 1, p - 1, xi, misprint);
  }
  return N;
}

// All functions of a knot vector at xi, in a full row: [k][i] = d^k N_i.
std::array<std::vector<double>, 3> full_rows(const KnotVector& knots, double xi) {
  BasisFunctions basis;
  evaluate_basis(knots, knots.find_span(xi), xi, 2, basis);
  std::array<std::vector<double>, 3> rows;
  for (int k = 0; k < 3; ++k) {
    rows[k].assign(knots.control_point_count(), 0.0);
    for (int j = 0; j <= knots.degree(); ++j) rows[k][basis.first + j] = basis.values[k][j];
  }
  return rows;
}

TEST(Basis, EqualsCoxDeBoorRecursion) {
  shapes::Random random(1);
  for (int p = 1; p <= kMaxDegree; ++p)
    for (int sample = 0; sample < 5; ++sample) {
      const KnotVector knots = shapes::random_knots(random, p, 6);
      for (int k = 0; k < 40; ++k) {
        // Every second one on a knot; the last knot itself belongs to no half-open span of the formula.
        const double xi =
            k % 2 ? shapes::uniform(random, 0.0, knots.back()) : knots.breaks()[k % knots.element_count()];
        const std::vector<double> N = full_rows(knots, xi)[0];
        for (int i = 0; i < knots.control_point_count(); ++i)
          EXPECT_NEAR(N[i], cox_de_boor(knots.knots(), i, p, xi), 1e-14) << "p " << p << " xi " << xi;
      }
    }
}

TEST(Basis, PapersEquation2IsAMisprint) {
  const std::vector<double> U{0, 0, 0, 1, 2, 3, 3, 3};
  double sum = 0.0, misprinted = 0.0;
  for (int i = 0; i < 5; ++i) {
    sum += cox_de_boor(U, i, 2, 1.5);
    misprinted += cox_de_boor(U, i, 2, 1.5, true);
  }
  EXPECT_NEAR(sum, 1.0, 1e-15);
  EXPECT_GT(std::abs(misprinted - 1.0), 0.5);
}

TEST(Basis, IsAPartitionOfUnity) {
  shapes::Random random(2);
  for (int p = 1; p <= kMaxDegree; ++p) {
    const KnotVector knots = shapes::random_knots(random, p, 6);
    for (int k = 0; k < 100; ++k) {
      const auto rows = full_rows(knots, shapes::uniform(random, 0.0, knots.back()));
      for (int order = 0; order < 3; ++order) {
        double sum = 0.0, size = 0.0;
        for (double value : rows[order]) sum += value, size += std::abs(value);
        EXPECT_NEAR(sum, order == 0 ? 1.0 : 0.0, 1e-14 * size);
        if (order == 0) {
          for (double value : rows[0]) EXPECT_GE(value, 0.0);
        }
      }
    }
  }
}

// On one span the functions are polynomials: differences may step over its ends.
TEST(Basis, DerivativesEqualFiniteDifferences) {
  shapes::Random random(3);
  for (int p = 1; p <= kMaxDegree; ++p) {
    const KnotVector knots = shapes::random_knots(random, p, 5);
    for (int e = 0; e < knots.element_count(); ++e) {
      const double length = knots.breaks()[e + 1] - knots.breaks()[e], h = 1e-4 * length;
      const double xi = knots.breaks()[e] + 0.37 * length;
      BasisFunctions at, before, after;
      evaluate_basis(knots, knots.span_of_element(e), xi, 2, at);
      evaluate_basis(knots, knots.span_of_element(e), xi - h, 1, before);
      evaluate_basis(knots, knots.span_of_element(e), xi + h, 1, after);
      for (int k = 0; k < 2; ++k)
        for (int j = 0; j <= p; ++j)
          EXPECT_NEAR(at.values[k + 1][j], (after.values[k][j] - before.values[k][j]) / (2 * h),
                      1e-6 * std::max(1.0, std::pow(p / 6.0, 3)) / std::pow(length, k + 1))
              << "degree " << p << " order " << k + 1;
    }
  }
}

// Table 1 and Fig. 1 of Gao & Feng (2019): degree 2, nine knots, six control nodes, four curve sections.
TEST(Basis, PapersFigure1Curve) {
  const KnotVector knots(2, {0, 0, 0, 1, 2, 3, 4, 4, 4});
  EXPECT_EQ(knots.knots().size(), 9u);
  EXPECT_EQ(knots.control_point_count(), 6);
  ASSERT_EQ(knots.element_count(), 4);
  const Curve curve{Space<1>({knots}), (NodalVectors(3, 6) << 0, 1, 2, 4, 5, 6,  //
                                        0, 2, -1, 3, 0, 1,                       //
                                        0, 0, 0, 0, 0, 0)
                                           .finished()};
  for (int section = 0; section < 4; ++section) {
    // Parameter space [xi_{3+c}, xi_{4+c}) in the paper's counting from 1, c = 0 .. 3.
    EXPECT_EQ(knots.breaks()[section], knots.knots()[2 + section]);
    EXPECT_EQ(knots.breaks()[section + 1], knots.knots()[3 + section]);
    // Control nodes N_{1+c}, N_{2+c}, N_{3+c}, and no others, act on the section.
    int acting[3];
    curve.space.element_control_points(section, acting);
    for (double t : {0.0, 0.3, 0.9}) {
      const double xi = section + t;
      const Vector3 point = interpolate(curve.space, curve.control_points, {xi});
      for (int node = 0; node < 6; ++node) {
        NodalVectors moved = curve.control_points;
        moved.col(node).y() += 1.0;
        const double moves = interpolate(curve.space, moved, {xi}).y() - point.y();
        const bool acts = node >= section && node <= section + 2;
        EXPECT_NEAR(moves, cox_de_boor(knots.knots(), node, 2, xi), 1e-15);
        if (acts) {
          EXPECT_EQ(acting[node - section], node);
        } else {
          EXPECT_EQ(moves, 0.0);
        }
      }
    }
  }
  // Three equal knots at the ends: the curve starts and ends in its first and last node.
  EXPECT_EQ(interpolate(curve.space, curve.control_points, {0.0}), curve.control_points.col(0));
  EXPECT_EQ(interpolate(curve.space, curve.control_points, {4.0}), curve.control_points.col(5));
}

// The blossom is symmetric, affine in each argument, and the curve on its diagonal: these three define it.
TEST(Basis, BlossomProperties) {
  shapes::Random random(4);
  for (int p = 2; p <= kMaxDegree; ++p) {
    const KnotVector knots = shapes::random_knots(random, p, 4);
    const int span = knots.span_of_element(1);
    const double low = knots.breaks()[1], high = knots.breaks()[2];
    std::vector<double> t(p), swapped, left, right;
    for (double& argument : t) argument = shapes::uniform(random, low, high);
    const auto blossom = [&](const std::vector<double>& arguments) {
      std::vector<double> out(kMaxDegree + 1, 0.0);
      evaluate_blossom(knots, span, arguments.data(), out.data());
      return out;
    };
    swapped = left = right = t;
    std::swap(swapped.front(), swapped.back());
    left[1] = low, right[1] = high;
    const double s = (t[1] - low) / (high - low);
    const auto at_t = blossom(t), at_swapped = blossom(swapped), at_left = blossom(left),
               at_right = blossom(right);
    const auto diagonal = blossom(std::vector<double>(p, t[0]));
    for (int j = 0; j <= p; ++j) {
      EXPECT_NEAR(at_t[j], at_swapped[j], 1e-12);
      EXPECT_NEAR(at_t[j], (1 - s) * at_left[j] + s * at_right[j], 1e-12);
      EXPECT_NEAR(diagonal[j], cox_de_boor(knots.knots(), span - p + j, p, t[0]), 1e-14);
    }
  }
}

}  // namespace
}  // namespace nurbs

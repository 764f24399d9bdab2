// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/knot_vector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "nurbs/shapes.h"

namespace nurbs {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string message_of(int degree, const std::vector<double>& knots) {
  try {
    KnotVector(degree, knots);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(KnotVector, RefusesBadOnesAndSaysWhy) {
  EXPECT_EQ(message_of(2, {0, 0, 0, 1, 2, 2, 3, 3, 3}), "accepted");
  EXPECT_THAT(message_of(0, {0, 1}), HasSubstr("degree is 0, expected 1 to 16"));
  EXPECT_THAT(message_of(17, std::vector<double>(36, 0.0)), HasSubstr("degree is 17, expected 1 to 16"));
  EXPECT_THAT(message_of(2, {0, 0, 1, 1}), HasSubstr("4 knots given, degree 2 expects at least 6"));
  EXPECT_THAT(message_of(1, {0, 0, NAN, 1, 1}), HasSubstr("knot 3 is nan, expected a finite number"));
  EXPECT_THAT(message_of(1, {0, 0, 2, 1, 3, 3}), HasSubstr("knot 4 is 1 after 2"));
  EXPECT_THAT(message_of(1, {1, 1, 1, 1}), HasSubstr("all knots are 1"));
  EXPECT_THAT(message_of(2, {0, 0, 1, 2, 2, 2}), HasSubstr("first knot 2 times and last knot 3 times"));
  EXPECT_THAT(message_of(2, {0, 0, 0, 1, 2, 2}), HasSubstr("not open"));
  EXPECT_THAT(message_of(1, {0, 0, 0, 1, 1}), HasSubstr("first knot 3 times and last knot 2 times"));
  EXPECT_THAT(message_of(2, {0, 0, 0, 1, 1, 1, 2, 2, 2}), HasSubstr("interior knot 1 stands 3 times"));
}

TEST(KnotVector, FromBreaksAndUniform) {
  const KnotVector graded = KnotVector::from_breaks(2, {0, 0.1, 0.4, 1});
  EXPECT_THAT(graded.knots(), ElementsAre(0, 0, 0, 0.1, 0.4, 1, 1, 1));
  EXPECT_THAT(graded.breaks(), ElementsAre(0, 0.1, 0.4, 1));
  EXPECT_EQ(graded.control_point_count(), 5);
  EXPECT_EQ(graded.element_count(), 3);
  EXPECT_THAT(KnotVector::uniform(1, 4, -1.0, 1.0).knots(), ElementsAre(-1, -1, -0.5, 0, 0.5, 1, 1));
  EXPECT_THROW(KnotVector::uniform(2, 0), std::invalid_argument);
  EXPECT_THROW(KnotVector::from_breaks(2, {0}), std::invalid_argument);
  EXPECT_THROW(KnotVector::from_breaks(2, {0, 0.5, 0.5, 1}), std::invalid_argument);
  EXPECT_THROW(KnotVector::from_breaks(-3, {0, 1}), std::invalid_argument);
}

TEST(KnotVector, CreasesAreTheKnotsOfFullMultiplicity) {
  EXPECT_THAT(KnotVector(2, {0, 0, 0, 1, 2, 2, 3, 3, 3}).creases(), ElementsAre(0, 2, 3));
  EXPECT_THAT(KnotVector(1, {0, 0, 1, 2, 2}).creases(), ElementsAre(0, 1, 2));
  EXPECT_THAT(KnotVector(3, {0, 0, 0, 0, 1, 1, 2, 2, 2, 2}).creases(), ElementsAre(0, 2));
}

// The span of every element and the element of every parameter, against a walk over the knots.
TEST(KnotVector, FindsSpans) {
  shapes::Random random(1);
  for (int degree = 1; degree <= kMaxDegree; ++degree) {
    const KnotVector knots = shapes::random_knots(random, degree, 7);
    const std::vector<double>& U = knots.knots();
    const int last = knots.control_point_count() - 1;
    const auto walked = [&](double xi) {
      int i = degree;
      while (i < last && U[i + 1] <= xi) ++i;
      return i;
    };
    std::vector<double> places = U;  // on knots, and between
    for (int k = 0; k < 50; ++k) places.push_back(shapes::uniform(random, U.front(), U.back()));
    for (double xi : places) {
      EXPECT_EQ(knots.find_span(xi), walked(xi)) << "degree " << degree << " xi " << xi;
      const int e = knots.element_at(xi);
      EXPECT_EQ(knots.span_of_element(e), walked(xi));
      EXPECT_LE(knots.breaks()[e], xi);
      EXPECT_GE(knots.breaks()[e + 1], xi);
    }
    EXPECT_EQ(knots.element_at(U.front() - 1.0), 0);
    EXPECT_EQ(knots.element_at(U.back() + 1.0), knots.element_count() - 1);
  }
}

TEST(KnotVector, GrevilleAbscissaeAreMeansOfKnots) {
  EXPECT_THAT(KnotVector(3, {0, 0, 0, 0, 3, 6, 6, 6, 6}).greville(), ElementsAre(0, 1, 3, 5, 6));
  const std::vector<double> t = KnotVector::from_breaks(3, {0.1, 0.25, 0.7}).greville();
  EXPECT_EQ(t.front(), 0.1);  // exactly: control points placed there meet the ends
  EXPECT_EQ(t.back(), 0.7);
}

}  // namespace
}  // namespace nurbs

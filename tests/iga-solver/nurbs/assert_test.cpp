// SPDX-License-Identifier: GPL-2.0-or-later
// Assertions fire in builds that have them, with the values, and cost nothing in others.
#include "nurbs/assert.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nurbs/control_area.h"
#include "nurbs/multi_patch.h"

namespace nurbs {
namespace {

MultiPatch flat_patch() {  // 2 x 3 elements
  return MultiPatch({Space<2>({KnotVector::uniform(2, 2), KnotVector::uniform(2, 3)})});
}

#ifdef NURBS_ASSERTIONS

template <class Action>
std::string complaint(Action action) {
  try {
    action();
  } catch (const AssertionFailed& failed) {
    return failed.what();
  }
  return "none";
}

TEST(Assert, NamesPlaceConditionAndValues) {
  const int element = 6, count = 4;
  EXPECT_THAT(complaint([&] { NURBS_ASSERT(element < count, element, count); }),
              testing::MatchesRegex(".*assert_test.cpp:[0-9]+: expected element < count; "
                                    "\\(element, count\\) = \\(6, 4\\)"));
  EXPECT_EQ(complaint([&] { NURBS_ASSERT(element > count, element, count); }), "none");
}

TEST(Assert, SeesIndicesOutsideASurface) {
  const MultiPatch surface = flat_patch();
  const Space<2>& patch = surface.patch(0);
  const NodalVectors one_too_few = NodalVectors::Zero(3, patch.control_point_count() - 1);
  BasisFunctions basis;
  for (const std::string& text : {
           complaint([&] { surface.patch_of_element(6); }),
           complaint([&] {
             surface.across({0, {0.0, 0.5}}, 0);
           }),  // a free edge
           complaint([&] { patch.element_indices(-1); }),
           complaint([&] {
             patch.element_index({0, 3});
           }),
           complaint([&] {
             interpolate(patch, one_too_few, {0.5, 0.5});
           }),
           complaint([&] { control_point_areas(patch, one_too_few); }),
           complaint([&] { evaluate_basis(patch.knots(0), 2, 0.75, 0, basis); }),
           complaint([&] { evaluate_basis(patch.knots(0), 4, 0.75, 0, basis); }),
       })
    EXPECT_THAT(text, testing::HasSubstr("expected"));
}

#else

TEST(Assert, EvaluatesNothing) {
  int evaluated = 0;
  const auto condition = [&] { return ++evaluated > 1; };
  NURBS_ASSERT(condition(), evaluated);
  EXPECT_EQ(evaluated, 0);
  EXPECT_EQ(flat_patch().patch_count(), 1);
}

#endif

}  // namespace
}  // namespace nurbs

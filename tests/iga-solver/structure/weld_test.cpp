// SPDX-License-Identifier: GPL-2.0-or-later
// Which control points of several patches are one node.
#include "structure/weld.h"

#include <gmock/gmock.h>

#include <map>

#include "models.h"
#include "nurbs/primitives.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using nurbs::KnotVector;
using nurbs::Volume;
using structure::Id;
using structure::NodeNumbering;
using structure::weld;

Volume moved(Volume patch, const Vector3& by) {
  patch.control_points.colwise() += by;
  return patch;
}

Volume ring(double from, double to, int elements, double length = 1.0) {
  return nurbs::tube(nurbs::frame({0, 0, 0}, {0, 0, 1}), 1.0, 2.0, length,
                     nurbs::refined(nurbs::arc(from, to), elements, 2),
                     {KnotVector::uniform(2, 2), KnotVector::uniform(2, 1)});
}

/// The same volume with xi and eta swapped and zeta reversed, which keeps it right-handed.
Volume turned(const Volume& patch) {
  const nurbs::Space<3>& space = patch.space;
  std::vector<double> knots = space.knots(2).knots();
  std::reverse(knots.begin(), knots.end());
  for (double& knot : knots) knot = 3.0 - 2.0 * knot;
  nurbs::Space<3> turned({space.knots(1), space.knots(0), KnotVector(space.degree(2), knots)});
  Volume result{turned, patch.control_points};
  const int n = space.control_point_count(0), m = space.control_point_count(1),
            l = space.control_point_count(2);
  for (int k = 0; k < l; ++k)
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < n; ++i)
        result.control_points.col(j + m * (i + n * (l - 1 - k))) =
            patch.control_points.col(i + n * (j + m * k));
  return result;
}

/// Every node has one place, and no two nodes of the patches' faces the same.
void expect_nodes_are_places(const std::vector<Volume>& patches, const NodeNumbering& nodes) {
  std::vector<Vector3> at(nodes.node_count(), Vector3::Constant(std::nan("")));
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (int a = 0; a < patches[p].control_points.cols(); ++a) {
      Vector3& place = at[nodes.node(static_cast<int>(p), a)];
      if (!std::isnan(place[0])) {
        EXPECT_LT((place - patches[p].control_points.col(a)).norm(), 1e-12);
      }
      place = patches[p].control_points.col(a);
    }
  for (const Vector3& place : at) EXPECT_FALSE(std::isnan(place[0])) << "a node without a place";
}

int welded_face_count(const std::vector<Volume>& patches, const NodeNumbering& nodes) {
  std::vector<nurbs::Space<3>> spaces;
  for (const Volume& patch : patches) spaces.push_back(patch.space);
  return static_cast<int>(structure::welded_faces(spaces, nodes).size()) / 2;
}

TEST(Weld, OnePatchKeepsItsControlPoints) {
  const Volume patch = models::block({1, 1, 1}, {2, 3, 4}, 2);
  const NodeNumbering nodes = weld({patch});
  EXPECT_EQ(nodes.node_count(), 4 * 5 * 6);
  EXPECT_TRUE(nodes.welded().empty());
  EXPECT_EQ(nodes.node(0, 57), 57);
  EXPECT_EQ(nodes.place(57).control_point, 57);
}

TEST(Weld, TwoBlocksShareAFaceHoweverTheyAreTurned) {
  const Volume first = models::block({1, 1, 1}, {2, 2, 2}, 2);  // 4 x 4 x 4 control points
  for (const Volume& second : {moved(first, {1, 0, 0}), turned(moved(first, {1, 0, 0}))}) {
    const NodeNumbering nodes = weld({first, second});
    EXPECT_EQ(nodes.node_count(), 2 * 64 - 16);
    EXPECT_EQ(nodes.welded().size(), 16u);
    EXPECT_EQ(welded_face_count({first, second}, nodes), 1);
    expect_nodes_are_places({first, second}, nodes);
    for (std::size_t i = 0; i < nodes.welded().size(); ++i) {
      const auto places = nodes.places_of_welded(i);
      ASSERT_EQ(places.size(), 2u);
      EXPECT_EQ(places[0].patch, 0);
      EXPECT_EQ(nodes.node(places[1].patch, places[1].control_point), nodes.welded()[i]);
      EXPECT_EQ(nodes.place(nodes.welded()[i]).control_point, places[0].control_point);
    }
  }
}

TEST(Weld, ATubeClosesWithItself) {
  const Volume tube = ring(0, 360, 8);
  const int across = tube.space.control_point_count(1) * tube.space.control_point_count(2);
  const NodeNumbering nodes = weld({tube});
  EXPECT_EQ(nodes.node_count(), tube.control_points.cols() - across);
  EXPECT_EQ(welded_face_count({tube}, nodes), 1);
  expect_nodes_are_places({tube}, nodes);
}

TEST(Weld, FourQuartersMakeATube) {
  std::vector<Volume> quarters;
  for (int k = 0; k < 4; ++k) quarters.push_back(ring(90.0 * k, 90.0 * (k + 1), 2));
  const NodeNumbering nodes = weld(quarters);
  EXPECT_EQ(nodes.node_count(), weld({ring(0, 360, 8)}).node_count() + 0) << "C0 at both kinds of joints";
  EXPECT_EQ(welded_face_count(quarters, nodes), 4);
  expect_nodes_are_places(quarters, nodes);
}

TEST(Weld, RoundFacesMayHaveTheirSeamsAtDifferentPlaces) {
  const std::vector<Volume> tubes{ring(0, 360, 8), moved(ring(90, 450, 8), {0, 0, 1})};
  const NodeNumbering nodes = weld(tubes);
  expect_nodes_are_places(tubes, nodes);
  EXPECT_EQ(welded_face_count(tubes, nodes), 3) << "two seams, and one tube on the other";
}

// The outer faces of two half tubes have the same corners, and so have the inner ones; they are no joints.
TEST(Weld, HalvesWithEqualCornersAreNoJoints) {
  const std::vector<Volume> halves{ring(0, 180, 4), ring(180, 360, 4)};
  const NodeNumbering nodes = weld(halves);
  EXPECT_EQ(welded_face_count(halves, nodes), 2);
}

TEST(Weld, MoreThanTwoMeetInAnEdge) {
  const Volume block = models::block({1, 1, 1}, {2, 2, 2}, 2);
  const std::vector<Volume> cross{block, moved(block, {1, 0, 0}), moved(block, {0, 1, 0}),
                                  moved(block, {1, 1, 0})};
  const NodeNumbering nodes = weld(cross);
  EXPECT_EQ(nodes.node_count(), 7 * 7 * 4);
  std::map<std::size_t, int> valence;
  for (std::size_t i = 0; i < nodes.welded().size(); ++i) ++valence[nodes.places_of_welded(i).size()];
  EXPECT_EQ(valence, (std::map<std::size_t, int>{{2, 4 * 3 * 4}, {4, 4}}));
}

TEST(Weld, AnEdgeShrunkToALineIsOneRowOfNodes) {
  Volume wedge = models::block({1, 1, 1}, {2, 2, 2}, 2);
  for (int a = 0; a < 64; ++a) wedge.control_points(1, a) *= wedge.control_points(0, a);
  const NodeNumbering nodes = weld({wedge});
  EXPECT_EQ(nodes.node_count(), 64 - 3 * 4);
  EXPECT_EQ(nodes.places_of_welded(0).size(), 4u);
}

TEST(Weld, ControlPointsThatCoincideInsideStayApart) {
  Volume patch = models::block({1, 1, 1}, {2, 2, 2}, 2);
  patch.control_points.col(1 + 4 * (1 + 4 * 1)) = patch.control_points.col(2 + 4 * (1 + 4 * 1));
  EXPECT_EQ(weld({patch}).node_count(), 64);
}

std::string message(const std::vector<Volume>& patches) {
  try {
    weld(patches);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Weld, RefusesTwoMeshesOnOneFace) {
  const Volume block = models::block({1, 1, 1}, {2, 2, 2}, 2);
  EXPECT_THAT(
      message({block, moved(models::block({1, 1, 1}, {2, 3, 2}, 2), {1, 0, 0})}),
      testing::HasSubstr("faces 'xi+' (4 x 4 control points of degrees 2, 2) and '1 xi-' (5 x 4 control "
                         "points of degrees 2, 2) are one surface, expected one mesh on both"));
  EXPECT_NE(message({block, moved(models::block({1, 1, 1}, {2, 2, 2}, {2, 3, 2}), {1, 0, 0})}), "");
}

// Half of the control points of the upper block's face stand where the lower one has some.
TEST(Weld, RefusesPatchesThatMeetInPartOfAFace) {
  const Volume block =
      nurbs::box({0, 0, 0}, {4, 4, 1},
                 {KnotVector::uniform(1, 4), KnotVector::uniform(1, 4), KnotVector::uniform(1, 1)});
  EXPECT_THAT(
      [&] {
        weld({block, moved(block, {2, 0, 1})});
      },
      testing::ThrowsMessage<std::invalid_argument>(
          testing::HasSubstr("patch 1 meets face 'zeta+' in part: 15 of the 25 control points")));
  EXPECT_THROW(weld({block, moved(block, {1, 1, 0})}), std::invalid_argument);  // one inside the other
  EXPECT_NO_THROW(weld({block, moved(block, {4, 0, 1})}));                      // an edge
  EXPECT_NO_THROW(weld({block, moved(block, {4, 2, 0}), moved(block, {0, 0, 1})}).node_count());
}

// Whole faces are shared, of the same mesh, by two patches on the same side of them.
TEST(Weld, RefusesPatchesInEachOther) {
  const Volume block = models::block({1, 1, 1}, {2, 2, 2}, 2), beside = moved(block, {1, 0, 0});
  EXPECT_EQ(message({block, beside, block}), "patches 0 and 2 are one volume given twice, expected it once");
  EXPECT_EQ(message({ring(0, 90, 2), ring(90, 180, 2), ring(90, 180, 2)}),
            "patches 1 and 2 are one volume given twice, expected it once");
  EXPECT_THAT(message({block, turned(block)}),
              testing::HasSubstr("patches 0 and 1 lie in each other: both are on the same side"));
  const auto bar = [](double height) { return models::block({1, 1, height}, {1, 1, 1}, 1); };
  EXPECT_THAT(
      message({bar(1), moved(bar(1), {0, 0, 1}), bar(3)}),
      testing::HasSubstr("patches 0 and 2 lie in each other: both are on the same side of the face that "
                         "they share, 'zeta-' and '2 zeta-', expected one on each side"));
  EXPECT_EQ(message({bar(1), moved(bar(2), {0, 0, 1}), moved(bar(1), {0, 0, -1})}), "");
  EXPECT_EQ(message({block, turned(beside)}), "");
}

TEST(Weld, RefusesOtherWeightsOnOneFace) {
  const Volume block = models::block({1, 1, 1}, {2, 2, 2}, 2);
  const auto weighted = [&](double inner) {
    std::vector<double> weights(64, 3.0);  // a constant factor changes nothing
    for (int k = 1; k < 3; ++k)
      for (int j = 1; j < 3; ++j) weights[4 * (j + 4 * k)] = inner;
    return Volume{nurbs::Space<3>(block.space.knots(), weights), moved(block, {1, 0, 0}).control_points};
  };
  EXPECT_EQ(message({block, weighted(3.0)}), "");
  EXPECT_NE(message({block, weighted(3.1)}), "");
}

/// In its second direction; control points stay.
Volume with_knots(const Volume& patch, std::vector<double> knots) {
  const nurbs::Space<3>& space = patch.space;
  return {nurbs::Space<3>({space.knots(0), KnotVector(space.degree(1), std::move(knots)), space.knots(2)}),
          patch.control_points};
}

// The middles of such faces are at different places.
TEST(Weld, RefusesOtherKnotsOrWeightsBetweenTheSameControlPoints) {
  const Volume block = models::block({1, 1, 1}, {1, 2, 1}, 2), beside = moved(block, {1, 0, 0});
  const auto other = [](const std::string& what) {
    return "faces 'xi+' and '1 xi-' have the same control points, but other " + what +
           ", expected one mesh on both: the same degrees, knots and weights, so that they can be welded";
  };
  EXPECT_EQ(message({block, with_knots(beside, {0, 0, 0, 0.3, 1, 1, 1})}), other("degrees or knots"));
  EXPECT_EQ(message({block, turned(with_knots(beside, {0, 0, 0, 0.3, 1, 1, 1}))}),
            "faces 'xi+' and '1 eta-' have the same control points, but other degrees or knots, expected one "
            "mesh on both: the same degrees, knots and weights, so that they can be welded");
  EXPECT_EQ(message({block, with_knots(beside, {-1, -1, -1, 2 + 1e-10, 5, 5, 5})}), "");
  EXPECT_EQ(message({with_knots(block, {0, 0, 0, 0.3, 1, 1, 1}),
                     turned(with_knots(beside, {0, 0, 0, 0.3, 1, 1, 1}))}),
            "");

  std::vector<double> weights(beside.control_points.cols(), 1.0);
  weights[3] = 1.5;
  EXPECT_EQ(message({block, {nurbs::Space<3>(beside.space.knots(), weights), beside.control_points}}),
            other("weights"));
  for (double& weight : weights) weight *= 3.7;
  std::vector<double> of_block(weights.size(), 2.0);
  of_block[5] = 3.0;  // on xi+, where the other one has its larger weight
  EXPECT_EQ(message({{nurbs::Space<3>(block.space.knots(), of_block), block.control_points},
                     {nurbs::Space<3>(beside.space.knots(), weights), beside.control_points}}),
            "");
}

// Between lines of no smoothness knots may be spread as they like: the functions of the place are the same.
TEST(Weld, PartsOfAFaceMayHaveAnyShareOfTheKnots) {
  const Volume block =
      nurbs::box({0, 0, 0}, {1, 1, 1},
                 {KnotVector::uniform(1, 1), KnotVector::uniform(1, 2), KnotVector::uniform(1, 1)});
  EXPECT_EQ(message({block, with_knots(moved(block, {1, 0, 0}), {0, 0, 0.3, 1, 1})}), "");
  const KnotVector joined(2, {0, 0, 0, 0.5, 0.75, 0.75, 1, 1, 1});
  const Volume smooth =
      nurbs::box({0, 0, 0}, {1, 1, 1}, {KnotVector::uniform(1, 1), joined, KnotVector::uniform(1, 1)});
  EXPECT_EQ(message({smooth, with_knots(moved(smooth, {1, 0, 0}), {0, 0, 0, 0.2, 0.3, 0.3, 1, 1, 1})}), "");
  EXPECT_NE(message({smooth, with_knots(moved(smooth, {1, 0, 0}), {0, 0, 0, 0.1, 0.3, 0.3, 1, 1, 1})}), "");
}

}  // namespace

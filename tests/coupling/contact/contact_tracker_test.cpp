// SPDX-License-Identifier: GPL-2.0-or-later
// Feet of many particles from step to step, on walls whose feet are known in closed form: more at a time than
// a block holds, several branches each, at kinks and at periodic images.
#include "coupling/contact/contact_tracker.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "coupling/contact/wall_shape.h"
#include "nurbs/primitives.h"

namespace contact {
namespace {

using nurbs::Vector3;

nurbs::Surface plate(const Vector3& origin, const Vector3& u, const Vector3& v) {
  return nurbs::plane(origin, u, v, {nurbs::KnotVector::uniform(2, 8), nurbs::KnotVector::uniform(2, 4)});
}

// A wall that stands, particles around it, and what the fix keeps of each.
class Scene {
 public:
  Scene(const std::vector<nurbs::Surface>& patches, std::vector<Vector3> centres, double touch, double list,
        std::vector<Vector3> images = {Vector3::Zero()}, int slot_count = 2, double edge_angle = 0.02)
      : surface_(nurbs::join(patches)),
        shape_(surface_.topology, surface_.control_points, two_sided_, edge_angle),
        tracker_(shape_.track(candidates_, SearchMethod::newton, counts_)),
        centres_(std::move(centres)),
        touch_(touch),
        list_(list) {
    shape_.begin_list(true);
    std::vector<double> empty = {ContactSlot::kEmpty, 0.0, 0.0};
    values_.resize(slot_count);
    for (std::vector<double>& rows : values_) {
      for (size_t k = 0; k < centres_.size(); ++k) rows.insert(rows.end(), empty.begin(), empty.end());
      slots_.push_back(rows.data());
    }
    const std::vector<double> reach(centres_.size(), list_);
    candidates_.build(
        {}, images, {static_cast<int>(centres_.size()), centres_[0].data(), reach.data()},
        [this](int, const Vector3& point, double near, std::vector<int>& elements) {
          shape_.near(point, near, elements);
        },
        [](const Vector3&, const Vector3&, double, const int*, int) { return false; });
    tracker_->list_is_new();
  }

  std::vector<Vector3>& centres() { return centres_; }
  ParticleSlots memory(int particle) {
    return ContactMemory{slots_.data(), static_cast<int>(slots_.size()), 0}.of(particle, used_[particle]);
  }
  const SearchCounts& counts() const { return counts_; }
  int contacts_begun() const { return contacts_begun_; }

  /// One step as the fix makes it, `block` candidates at a time: take(particle, its feet).  Feet that touch
  /// get a slot.
  template <class Take>
  void step(int block, const Take& take) {
    tracker_->begin_step(0.0);
    const std::vector<Candidate>& all = candidates_.candidates();
    ASSERT_EQ(all.size(), centres_.size());
    std::vector<ContactTracker::Query> queries;
    for (size_t c = 0; c < all.size(); ++c) {
      queries.push_back(
          {static_cast<int>(c), all[c].particle, centres_[all[c].particle], touch_, list_, 0.0});
      if (queries.size() < static_cast<size_t>(block) && c + 1 < all.size()) continue;
      tracker_->follow(queries.data(), static_cast<int>(queries.size()));
      for (const ContactTracker::Query& query : queries) resolve(query, take);
      queries.clear();
    }
  }

 private:
  template <class Take>
  void resolve(const ContactTracker::Query& query, const Take& take) {
    const int particle = candidates_.candidates()[query.candidate].particle;
    const ParticleSlots slots = memory(particle);
    const FeetRange feet = tracker_->feet(query, slots);
    for (TrackedFoot& tracked : feet) {
      if (tracked.foot.distance > touch_) {
        if (tracked.slot >= 0) slots.slot(tracked.slot).clear();
        tracked.slot = -1;
        continue;
      }
      if (tracked.slot < 0) {
        tracked.slot = slots.take_empty();
        ++contacts_begun_;
      }
      slots.slot(tracked.slot).set_foot(tracked.foot.at(), 0);
    }
    take(particle, feet);
  }

  nurbs::PatchedSurface surface_;
  std::vector<int> two_sided_ = std::vector<int>(surface_.topology.patch_count(), 0);
  PatchShape shape_;
  CandidateList candidates_;
  SearchCounts counts_;
  std::unique_ptr<FeetTracker> tracker_;
  std::vector<Vector3> centres_;
  double touch_, list_;
  std::vector<std::vector<double>> values_;  // of each slot, a row for each particle
  std::vector<double*> slots_;
  std::vector<int> used_ = std::vector<int>(centres_.size(), 0);  // of them, by particle
  int contacts_begun_ = 0;
};

// Between two plates each particle has two feet, and each keeps its slot, whatever the size of the block: 300
// feet are more than are followed at a time, from 63 on to 65 around that number itself.
TEST(ContactTracker, FollowsTwoBranchesOfManyParticles) {
  constexpr double kGap = 0.5;
  for (const auto& [particles, block] :
       {std::pair(150, 64), std::pair(150, 150), std::pair(31, 64), std::pair(32, 32), std::pair(33, 64),
        std::pair(64, 64), std::pair(65, 65), std::pair(1, 1)}) {
    SCOPED_TRACE(testing::Message() << particles << " particles by " << block);
    std::vector<Vector3> centres;
    for (int k = 0; k < particles; ++k)
      centres.emplace_back(-2.0 + 0.3 * (k % 15), -1.5 + 0.3 * (k / 15), 0.1 * std::sin(k));
    Scene scene({plate({-4, -3, -kGap}, {8, 0, 0}, {0, 6, 0}), plate({-4, -3, kGap}, {8, 0, 0}, {0, 6, 0})},
                centres, 0.7, 0.9);
    for (int step = 0; step < 12; ++step) {
      int seen = 0;
      scene.step(block, [&](int particle, const FeetRange& feet) {
        const Vector3& d = scene.centres()[particle];
        ASSERT_EQ(feet.count, 2) << "particle " << particle << ", step " << step;
        for (const TrackedFoot& tracked : feet) {
          const double z = tracked.foot.patch == 0 ? -kGap : kGap;
          EXPECT_LT((tracked.foot.point - Vector3(d[0], d[1], z)).norm(), 1e-13)
              << particle << ", step " << step;
          EXPECT_NEAR(tracked.foot.distance, std::abs(z - d[2]), 1e-13);
          ASSERT_GE(tracked.slot, 0);
          EXPECT_EQ(scene.memory(particle).slot(tracked.slot).foot().patch, tracked.foot.patch);
        }
        EXPECT_NE(feet.first[0].slot, feet.first[1].slot);
        ++seen;
      });
      EXPECT_EQ(seen, particles);
      // All feet were found once by a search of all candidates, then followed.
      EXPECT_EQ(scene.counts().cold, 2 * particles);
      for (int k = 0; k < particles; ++k)
        scene.centres()[k] += 0.05 * Vector3(std::cos(k), std::sin(2.0 * k), 0.2 * std::sin(step));
    }
  }
}

// A trough of two plates, steep on the left: beside the kink feet are found anew in each step, and the slot
// goes with its side; out of reach it is given back.
TEST(ContactTracker, SlotsStayWithTheirSideOfAKink) {
  const double slope = 0.5;  // right side z = x / 2; left side z = -2 x
  const std::vector<nurbs::Surface> trough = {plate({-1, -1, 2}, {1, 0, -2}, {0, 2, 0}),
                                              plate({0, -1, 0}, {2, 0, 1}, {0, 2, 0})};
  const Vector3 normals[2] = {Vector3(2, 0, 1).normalized(), Vector3(-slope, 0, 1).normalized()};
  std::vector<Vector3> centres;
  for (int k = 0; k < 40; ++k) centres.emplace_back(0.0, -0.6 + 0.03 * k, 0.2);
  Scene scene(trough, centres, 0.3, 0.5);
  int slot_of[2] = {-1, -1};
  for (int step = 0; step < 60; ++step) {
    // Up the right side, out of reach of the left one, and back.
    const double along = 0.25 * (1.0 - std::cos(2.0 * M_PI * step / 50.0)) + 0.05;
    for (Vector3& centre : scene.centres()) {
      const double y = centre[1];
      centre = along * Vector3(2, 0, 1).normalized() + 0.15 * normals[1];
      centre[1] = y;
    }
    scene.step(64, [&](int particle, const FeetRange& feet) {
      const Vector3& d = scene.centres()[particle];
      int touching = 0;
      for (const TrackedFoot& tracked : feet) {
        const int side = tracked.foot.patch;
        const double height = d.dot(normals[side]);
        EXPECT_NEAR(tracked.foot.distance, height, 1e-13);
        EXPECT_LT((tracked.foot.point - (d - height * normals[side])).norm(), 1e-13);
        if (tracked.slot < 0) continue;
        ++touching;
        if (particle > 0) continue;
        EXPECT_TRUE(slot_of[side] < 0 || tracked.slot == slot_of[side]) << "step " << step;
      }
      const bool left = d.dot(normals[0]) <= 0.3;
      EXPECT_EQ(touching, left ? 2 : 1) << "particle " << particle << ", step " << step;
      int used = 0;
      for (int s = 0; s < 2; ++s) used += !scene.memory(particle).slot(s).empty();
      EXPECT_EQ(used, touching);
      if (particle > 0) return;
      for (const TrackedFoot& tracked : feet) slot_of[tracked.foot.patch] = tracked.slot;
      if (!left) slot_of[0] = -1;
    });
  }
}

// The patches of a trough z = slope |x|: two of them, or one with a crease.
std::vector<nurbs::Surface> shallow_trough(double slope, bool is_one_patch) {
  if (!is_one_patch)
    return {plate({-2, -1, 2 * slope}, {2, 0, -2 * slope}, {0, 2, 0}),
            plate({0, -1, 0}, {2, 0, 2 * slope}, {0, 2, 0})};
  nurbs::Surface sheet = nurbs::plane({-2, -1, 0}, {4, 0, 0}, {0, 2, 0},
                                      {nurbs::KnotVector::uniform(1, 4), nurbs::KnotVector::uniform(2, 4)});
  sheet.control_points.row(2) = slope * sheet.control_points.row(0).cwiseAbs();
  return {sheet};
}

// Where a trough turns by less than the edge angle the nearer foot alone counts, so a particle that rolls
// through has one contact and a force that jumps by less than that angle; where it turns by more, both count.
TEST(ContactTracker, AKinkBelowTheEdgeAngleHasOneFoot) {
  constexpr double kHeight = 0.25, kSlope = 0.009;  // turns by 0.018
  const double sine = kSlope / std::hypot(1.0, kSlope);
  for (const bool is_one_patch : {false, true}) {
    const std::vector<nurbs::Surface> trough = shallow_trough(kSlope, is_one_patch);
    for (int k = -30; k < 30; ++k) {
      const double x =
          0.1 * (k + 0.5) * kHeight * kSlope;  // both sides have a foot within height * slope of the kink
      const Vector3 centre(x, 0.1, kHeight);
      const auto count = [&](double edge_angle) {
        Scene scene(trough, {centre}, 0.3, 0.5, {Vector3::Zero()}, 2, edge_angle);
        int feet_found = 0;
        scene.step(1, [&](int, const FeetRange& feet) {
          feet_found = feet.count;
          const double nearest = (kHeight - kSlope * std::abs(x)) * std::sqrt(1.0 - sine * sine);
          EXPECT_NEAR(feet.first[0].foot.distance, nearest, edge_angle > 0.0 ? 1e-13 : kHeight * kSlope) << x;
        });
        return feet_found;
      };
      EXPECT_EQ(count(0.02), 1) << x;
      EXPECT_EQ(count(0.017), std::abs(k + 0.5) < 10.0 ? 2 : 1) << x;
    }
    // From one side to the other with one list.
    Scene rolling(trough, {Vector3(-0.1, 0.1, kHeight)}, 0.3, 0.5);
    for (int k = 0; k <= 200; ++k) {
      const double x = -0.1 + 0.001 * k;
      rolling.centres()[0] = Vector3(x, 0.1, kHeight);
      rolling.step(1, [&](int, const FeetRange& feet) {
        ASSERT_EQ(feet.count, 1) << x;
        EXPECT_EQ(feet.first[0].slot, 0) << x;
        EXPECT_NEAR(feet.first[0].foot.distance, kHeight - kSlope * std::abs(x), 4.0 * kHeight * sine * sine)
            << x;
      });
    }
    EXPECT_EQ(rolling.contacts_begun(), 1) << "one contact, with its memory";
  }
}

// The same on sides so round that feet are looked for anew in each step, z = x^2 + slope |x|.
TEST(ContactTracker, AContactKeepsItsSlotThroughASmoothKink) {
  std::vector<nurbs::Surface> trough = shallow_trough(0.004, false);
  for (nurbs::Surface& side : trough) {
    const std::vector<double>& t = side.space.knots(0).knots();
    const double from = side.control_points(0, 0);
    for (Eigen::Index a = 0; a < side.control_points.cols(); ++a) {
      const auto i = static_cast<std::size_t>(a % side.space.control_point_count(0));
      side.control_points(2, a) += (from + 2.0 * t[i + 1]) * (from + 2.0 * t[i + 2]);
    }
  }
  Scene rolling(trough, {Vector3(-0.01, 0.1, 0.25)}, 0.3, 0.9);
  for (int k = 0; k <= 200; ++k) {
    rolling.centres()[0][0] = -0.01 + 1e-4 * k;
    rolling.step(1, [&](int, const FeetRange& feet) { EXPECT_EQ(feet.count, 1) << k; });
  }
  EXPECT_EQ(rolling.contacts_begun(), 1);
}

// Also where it turns by more than a right angle, up to pi.
TEST(ContactTracker, ASharpKinkBelowTheEdgeAngleHasOneFoot) {
  constexpr double kDistance = 0.25;
  for (const bool is_one_patch : {false, true})
    for (const double turn : {1.4, 1.7, 2.4, 2.9}) {
      const double height = kDistance / std::cos(0.5 * turn);
      const std::vector<nurbs::Surface> trough = shallow_trough(std::tan(0.5 * turn), is_one_patch);
      const auto count = [&](double edge_angle) {
        Scene scene(trough, {Vector3(1e-3 * kDistance, 0.1, height)}, 0.3, 0.3, {Vector3::Zero()}, 2,
                    edge_angle);
        int feet_found = 0;
        scene.step(1, [&](int, const FeetRange& feet) { feet_found = feet.count; });
        return feet_found;
      };
      EXPECT_EQ(count(0.99 * turn), 2) << turn << ' ' << is_one_patch;
      EXPECT_EQ(count(1.01 * turn), 1) << turn << ' ' << is_one_patch;
      EXPECT_EQ(count(M_PI), 1) << turn << ' ' << is_one_patch;
    }
}

// In the trough z = x^2 a particle above the centre of curvature (0, 1/2) has a foot on each side; as it
// sinks they grow together, and one of their slots is given back.
TEST(ContactTracker, BranchesGrowTogether) {
  nurbs::Surface trough = plate({-2, -2, 0}, {4, 0, 0}, {0, 4, 0});
  const std::vector<double> u = trough.space.knots(0).greville();
  for (Eigen::Index a = 0; a < trough.control_points.cols(); ++a) {
    // Of x^2 on uniform parabolas: the product of the two knots that a Greville abscissa is the mean of.
    const int i = static_cast<int>(a % static_cast<Eigen::Index>(u.size()));
    const std::vector<double>& t = trough.space.knots(0).knots();
    trough.control_points(2, a) = (4.0 * t[i + 1] - 2.0) * (4.0 * t[i + 2] - 2.0);
  }
  for (const double image : {0.0, -20.0})  // the wall itself, or a copy of it below
    for (const bool rises : {false, true}) {
      const Vector3 shift(0, 0, image);
      const double from = rises ? 0.33 : 1.08, way = rises ? 0.05 : -0.05;
      Scene scene({trough}, {Vector3(0, 0.1, from) + shift, Vector3(0, 0.3, from) + shift}, 1.2, 1.4,
                  {shift});
      for (int step = 0; step < 16; ++step) {
        const double z = from + way * step;
        for (Vector3& centre : scene.centres()) centre[2] = z + image;
        scene.step(64, [&](int particle, const FeetRange& feet) {
          SCOPED_TRACE(testing::Message() << "particle " << particle << " at " << z << ", image " << image);
          ASSERT_EQ(feet.count, z > 0.5 ? 2 : 1);
          const double x2 = std::max(z - 0.5, 0.0);
          for (const TrackedFoot& tracked : feet)
            EXPECT_NEAR(tracked.foot.distance, std::sqrt(x2 + (z - x2) * (z - x2)), 1e-9);
          int used = 0;
          for (int s = 0; s < 2; ++s) used += !scene.memory(particle).slot(s).empty();
          EXPECT_EQ(used, feet.count);
        });
      }
    }
}

// A saw of period 1: ridges in the middle of the wall, valleys where it meets its own image.  In a valley one
// foot is on each; above a ridge and above a valley's end each minimum counts once, though two images have
// it.
TEST(ContactTracker, FeetOfImagesAtEdgesAndKinks) {
  const std::vector<nurbs::Surface> saw = {plate({-0.5, -1, 0}, {0.5, 0, 0.5}, {0, 2, 0}),
                                           plate({0, -1, 0.5}, {0.5, 0, -0.5}, {0, 2, 0})};
  const Vector3 period(1, 0, 0);
  std::vector<Vector3> centres;
  for (int k = 0; k < 30; ++k) centres.emplace_back(0.5 + 0.002 * (k - 15), -0.6 + 0.04 * k, 0.2);
  for (int k = 0; k < 30; ++k) centres.emplace_back(-0.5 + 0.002 * (k - 15), -0.6 + 0.04 * k, 0.2);
  for (int k = 0; k < 30; ++k) centres.emplace_back(0.002 * (k - 15), -0.6 + 0.04 * k, 0.7);
  Scene scene(saw, centres, 0.25, 0.35, {Vector3::Zero(), period, -period});
  std::vector<std::array<int, 2>> slots(60, {-1, -1});
  for (int step = 0; step < 10; ++step) {
    scene.step(64, [&](int particle, const FeetRange& feet) {
      const Vector3& d = scene.centres()[particle];
      SCOPED_TRACE(testing::Message() << "particle " << particle << ", step " << step);
      if (particle >= 60) {
        ASSERT_EQ(feet.count, 1);
        EXPECT_LT((feet.first->foot.point - Vector3(0, d[1], 0.5)).norm(), 1e-13);
        return;
      }
      ASSERT_EQ(feet.count, 2);
      const double valley = particle < 30 ? 0.5 : -0.5;
      for (const TrackedFoot& tracked : feet) {
        // The falling side is left of the valley, the rising one right.
        const bool falling = tracked.foot.patch == 1;
        const Vector3 normal = Vector3(falling ? 1 : -1, 0, 1).normalized();
        const double height = (d - Vector3(valley, 0, 0)).dot(normal);
        EXPECT_NEAR(tracked.foot.distance, height, 1e-13);
        EXPECT_LT((tracked.foot.point - (d - height * normal)).norm(), 1e-13);
        EXPECT_EQ(tracked.foot.image,
                  falling ? Vector3((valley - 0.5) * period) : Vector3((valley + 0.5) * period));
        ASSERT_GE(tracked.slot, 0);
        EXPECT_TRUE(step == 0 || tracked.slot == slots[particle][tracked.foot.patch]);
        slots[particle][tracked.foot.patch] = tracked.slot;
      }
      EXPECT_NE(slots[particle][0], slots[particle][1]);
    });
    for (Vector3& centre : scene.centres()) centre += 0.002 * Vector3(std::sin(step), 1.0, 0.0);
  }
}

// On the axis of a tube and in the middle of a ball the feet are a row of equally near points, and one
// contact; beside the axis there is one foot as well.
TEST(ContactTracker, OneContactOnACentreOfCurvature) {
  constexpr double kRadius = 2.0;
  using nurbs::arc, nurbs::refined;
  const Vector3 middle(1, 2, 3), axis(0, 0, 1);
  const nurbs::Surface tube = nurbs::cylinder(nurbs::frame(middle - 10.0 * axis, axis), kRadius, 20.0,
                                              refined(arc(0, 360), 8, 2), nurbs::KnotVector::uniform(2, 20));
  const nurbs::Surface ball = nurbs::sphere(nurbs::frame(middle, axis), kRadius, refined(arc(0, 360), 8, 2),
                                            refined(arc(-90, 90), 4, 2));
  const auto expect_one = [&](const nurbs::Surface& surface, double aside) {
    Scene scene({surface}, {middle + Vector3(aside, 0, 0)}, 2.1, 2.2);
    scene.step(64, [&](int, const FeetRange& feet) {
      ASSERT_EQ(feet.count, 1);
      EXPECT_NEAR(feet.first->foot.distance, kRadius - aside, 1e-12);
    });
  };
  expect_one(tube, 0.0);
  expect_one(tube, 0.3);
  expect_one(ball, 0.0);
}

}  // namespace
}  // namespace contact

// SPDX-License-Identifier: GPL-2.0-or-later
// The words that move a rigid wall: those of LIGGGHTS' decks are understood, wrong ones are refused with what
// was given and what was expected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "motion_words.h"
#include "nurbs/primitives.h"

namespace {

using coupling::RigidDrive;
using coupling::Vector3;
using liggghts_pkg::WordReader;
using testing::HasSubstr;

coupling::Value variable(const std::string& name) {
  if (name != "speed") throw std::invalid_argument("'v_" + name + "' is given, but there is no variable");
  return coupling::Value([] { return 7.0; });
}

/// Reads a whole line of the keywords; words that are left over are an error of the test.
RigidDrive read(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  WordReader reader(words, 0);
  RigidDrive drive;
  while (!reader.at_end()) {
    const std::string keyword = reader.keyword();
    EXPECT_THAT(liggghts_pkg::drive_keywords(), testing::Contains(keyword)) << line;
    liggghts_pkg::read_drive(keyword, reader, variable, drive);
  }
  return drive;
}

/// Where `point` is after 10 steps of 0.01.
Vector3 moved(const std::string& line, const Vector3& point) {
  coupling::RigidMotion motion(read(line).motions);
  coupling::MovingFrame body;
  for (int n = 0; n < 10; ++n) motion.advance(body, 0.01);
  return body.frame().to_space(point);
}

// Each verb against the same motion made without words.
TEST(MotionWords, VerbsOfFixMoveMesh) {
  const Vector3 centre(1, 2, 3), axis(0, 1, 1), point(4, 0, -1);
  const coupling::Harmonics harmonics{{0.4, 0.1}, {1.3, 2}, {0.02, 0.07}};
  const coupling::Value speed = variable("speed");
  const std::vector<std::pair<std::string, coupling::Motion>> verbs = {
      {"linear 5. -5. +0.5", coupling::linear({5, -5, 0.5})},
      {"linear/variable v_speed 0 1e-1", coupling::linear_variable(speed, 0.0, 0.1)},
      {"wiggle amplitude -0.1 0. 0. period 0.03", coupling::wiggle({-0.1, 0, 0}, 0.03)},
      {"riggle origin 1 2 3 axis 0 1 1 period 0.3 amplitude 30", coupling::riggle(centre, axis, 0.3, 30)},
      {"rotate origin 1 2 3 axis 0 1 1 period -0.05", coupling::rotate(centre, axis, -0.05)},
      {"rotate/variable origin 1 2 3 axis 0 1 1 omega v_speed",
       coupling::rotate_variable(centre, axis, speed)},
      {"viblin axis 0 1 1 order 2 amplitude 0.4 0.1 phase 1.3 2 period 0.02 0.07",
       coupling::viblin(axis, harmonics)},
      {"vibrot origin 1 2 3 axis 0 1 1 order 2 amplitude 0.4 0.1 phase 1.3 2 period 0.02 0.07",
       coupling::vibrot(centre, axis, harmonics)},
  };
  for (const auto& [words, expected] : verbs) {
    coupling::RigidMotion motion({expected});
    coupling::MovingFrame body;
    for (int n = 0; n < 10; ++n) motion.advance(body, 0.01);
    EXPECT_EQ(moved("motion " + words, point), body.frame().to_space(point)) << words;
    EXPECT_NE(moved("motion " + words, point), point) << words;
  }
}

TEST(MotionWords, SeveralMotionsActInTheirOrder) {
  const RigidDrive drive = read("motion linear 1 0 0 motion rotate origin 0 0 0 axis 0 0 1 period 2");
  ASSERT_EQ(drive.motions.size(), 2u);
  EXPECT_EQ(drive.motions[0].verb, "linear");
  EXPECT_EQ(drive.motions[1].verb, "rotate");
  EXPECT_EQ(liggghts_pkg::drive_name(drive), "motion");
}

TEST(MotionWords, ServoOfMeshModule) {
  const RigidDrive drive =
      read("servo com 0. 0. 1. ctrlPV torque axis 0. 0. 2. target_val -10 vel_max 1. kp 5. ki 0.5 kd 1e-3");
  ASSERT_TRUE(drive.servo);
  EXPECT_EQ(drive.servo->com, Vector3(0, 0, 1));
  EXPECT_EQ(drive.servo->controls, coupling::ServoSettings::Controls::torque);
  EXPECT_EQ(drive.servo->axis, Vector3(0, 0, 1));
  EXPECT_EQ(drive.servo->target(), -10.0);
  EXPECT_EQ(drive.servo->vel_max, 1.0);
  EXPECT_EQ(drive.servo->kp, 5.0);
  EXPECT_EQ(drive.servo->ki, 0.5);
  EXPECT_EQ(drive.servo->kd, 1e-3);
  EXPECT_FALSE(drive.servo->automatic);
}

TEST(MotionWords, ServoInAutomaticModeWithAVariableTarget) {
  const RigidDrive drive =
      read("servo com 0 0 0 ctrlPV force axis 0 0 1 target_val v_speed vel_max 1. ratio 0.01 mode auto");
  EXPECT_TRUE(drive.servo->target.varies());
  EXPECT_EQ(drive.servo->target(), 7.0);
  EXPECT_EQ(drive.servo->kp, 0.01) << "LIGGGHTS' default";
  EXPECT_EQ(drive.servo->automatic->ratio, 0.01);
}

TEST(MotionWords, SlidingSurfacesOfFixMeshSurface) {
  const Vector3 x(1, 0, 0), normal(0, 0, 1);
  RigidDrive belt = read("surface_vel 0 v_speed 0");
  EXPECT_TRUE(belt.sliding->varies());
  belt.sliding->update();
  EXPECT_EQ(belt.sliding->velocity(x, normal), Vector3(0, 7, 0));
  const RigidDrive roller = read("surface_ang_vel origin 0 1 0 axis 0 0 2 omega 3.");
  EXPECT_LE((roller.sliding->velocity(x, normal) - Vector3(3, 3, 0)).norm(), 1e-15);
}

/// A wall of one flat patch.
coupling::RigidSurface wall_with(const std::string& line) {
  const nurbs::KnotVector linear = nurbs::KnotVector::from_breaks(1, {0.0, 1.0});
  coupling::RigidSurface wall({nurbs::plane({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {linear, linear})});
  wall.drive(read(line));
  wall.set_time_step(0.01);
  return wall;
}

/// Reads a line of fix_modify's words; returns how many were read.
std::size_t change(const std::string& line, coupling::RigidSurface& wall) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  WordReader reader(words, 0);
  liggghts_pkg::change_drive(reader, variable, wall);
  return reader.position();
}

TEST(FixModify, OtherMotionsStartFromWhereTheWallIs) {
  coupling::RigidSurface wall = wall_with("motion linear 1 0 0");
  wall.begin_step();
  EXPECT_EQ(change("motion linear 0 2 0 motion rotate origin 0 0 0 axis 0 0 1 period 1 energy yes", wall),
            17u);
  EXPECT_EQ(wall.frame().velocity, Vector3::Zero());
  wall.begin_step();
  const Vector3 moved(0.01, 0.02, 0), centre(0, 0.02, 0);
  const Eigen::AngleAxisd turn(0.02 * EIGEN_PI, Vector3::UnitZ());
  EXPECT_LE((wall.frame().origin - (centre + turn * (moved - centre))).norm(), 1e-16);
  change("motion none", wall);
  EXPECT_FALSE(wall.moves());
  EXPECT_EQ(wall.frame().velocity_at({1, 2, 3}), Vector3::Zero());
}

TEST(FixModify, WordsOfTheMeshModuleServo) {
  coupling::RigidSurface wall =
      wall_with("servo com 0 0 0 ctrlPV force axis 0 0 1 target_val 5 vel_max 1 mode auto ratio 0.1");
  const coupling::ServoSettings& settings = wall.servo()->settings();
  EXPECT_EQ(change("servo/integrate stop", wall), 2u);
  EXPECT_FALSE(settings.integrate);
  change("servo/integrate start", wall);
  EXPECT_TRUE(settings.integrate);
  change("servo/target_val v_speed", wall);
  EXPECT_EQ(settings.target(), 7.0);
  change("servo/vel_max 0.25", wall);
  EXPECT_EQ(settings.vel_max, 0.25);
  EXPECT_EQ(change("servo/ctrlParam 1 2 3", wall), 4u);
  EXPECT_EQ(settings.kp + 10 * settings.ki + 100 * settings.kd, 321.0);
  change("servo/ratio 0.5", wall);
  EXPECT_EQ(settings.automatic->ratio, 0.5);
}

// The integral of a controller with k_i alone is its speed: v = -vel_max * sum(error dt) / target.
TEST(FixModify, ANewTargetAndNewGainsForgetFormerErrors) {
  for (const char* line : {"servo/target_val 5", "servo/ctrlParam 0 1 0", "servo/vel_max 1"}) {
    coupling::RigidSurface wall =
        wall_with("servo com 0 0 0 ctrlPV force axis 0 0 1 target_val 5 vel_max 1 kp 0 ki 1 kd 0");
    const coupling::NodalForces none(coupling::NodalVectors::Zero(3, wall.positions().cols()));
    const auto speed_after_steps = [&](int steps) {  // nothing is felt: the error is -5 in each
      for (int i = 0; i < steps; ++i) {
        wall.begin_step();
        wall.end_step(none);
      }
      wall.begin_step();
      return wall.frame().velocity[2];
    };
    EXPECT_NEAR(speed_after_steps(10), 0.1, 1e-15);
    change(line, wall);
    const bool remembers = std::string(line).find("vel_max") != std::string::npos;
    EXPECT_NEAR(speed_after_steps(10), remembers ? 0.2 : 0.1, 1e-15) << line;
  }
}

TEST(FixModify, WrongWordsAreRefused) {
  coupling::RigidSurface servo = wall_with("servo com 0 0 0 ctrlPV force axis 0 0 1 target_val 5 vel_max 1");
  coupling::RigidSurface moving = wall_with("motion linear 1 0 0");
  const std::vector<std::tuple<coupling::RigidSurface*, std::string, std::string>> table = {
      {&moving, "colour red", "'colour' is unknown, expected one of motion"},
      {&moving, "motion", "'motion' is the last word"},
      {&moving, "motion rotat", "'rotat'"},
      {&moving, "servo/vel_max 1", "'servo/vel_max' needs a wall with a servo"},
      {&servo, "motion linear 1 0 0", "servo"},
      {&servo, "servo/vel_max 0", "above 0"},
      {&servo, "servo/integrate pause", "'start' or 'stop'"},
      {&servo, "servo/target_val 0", "0"},
      {&servo, "servo/ctrlParam 0 0 0", "all 0"},
      {&servo, "servo/ratio 0.1", "mode auto"},
  };
  for (const auto& [wall, line, expected] : table) {
    SCOPED_TRACE(line);
    try {
      change(line, *wall);
      ADD_FAILURE() << "expected std::invalid_argument";
    } catch (const std::invalid_argument& problem) {
      EXPECT_THAT(problem.what(), testing::AllOf(HasSubstr("fix_modify"), HasSubstr(expected)));
    }
  }
}

struct WrongWords {
  std::string line;
  std::vector<std::string> expected;  ///< parts of the message
};

TEST(MotionWords, WrongWordsAreRefused) {
  const std::string servo = "servo com 0 0 0 ctrlPV force axis 0 0 1 target_val 5 vel_max 1";
  const std::vector<WrongWords> table = {
      {"motion", {"'motion' is the last word", "one of linear"}},
      {"motion rotat origin", {"'rotat'", "did you mean 'rotate'"}},
      {"motion linear 1 2", {"'2' is the last word", "number"}},
      {"motion linear 1 2 up", {"motion: linear is 'up'", "number"}},
      {"motion linear 1 2 nan", {"'nan'", "number"}},
      {"motion linear 1 2 1e999", {"'1e999'", "number"}},
      {"motion linear 1 2 3mm", {"'3mm'", "number"}},
      {"motion linear 1 2 +-3", {"'+-3'", "number"}},
      {"motion linear v_speed 0 0", {"'v_speed'", "number"}},
      {"motion linear/variable v_sped 0 0", {"'v_sped'", "no variable"}},
      {"motion wiggle 1 0 0 period 1", {"'1' stands where 'amplitude' is expected"}},
      {"motion wiggle amplitude 1 0 0 frequency 1", {"'frequency'", "'period' is expected"}},
      {"motion wiggle amplitude 1 0 0 period 0", {"period is 0"}},
      {"motion rotate axis 0 0 1 origin 0 0 0 period 1", {"'axis'", "'origin' is expected"}},
      {"motion rotate origin 0 0 0 axis 0 0 0 period 1", {"axis is 0 0 0", "direction"}},
      {"motion rotate origin 0 0 0 axis 0 0 1 omega 1", {"'omega'", "'period' is expected"}},
      {"motion rotate/variable origin 0 0 0 axis 0 0 1 period 1", {"'period'", "'omega' is expected"}},
      {"motion riggle origin 0 0 0 axis 0 0 1 period 1", {"'1' is the last word", "'amplitude'"}},
      {"motion viblin axis 1 0 0 order 0", {"order is '0'", "1 to 1000"}},
      {"motion viblin axis 1 0 0 order 2000000000 amplitude 1", {"order is '2000000000'", "1 to 1000"}},
      {"motion viblin axis 1 0 0 order 2 amplitude 1 phase 0 0", {"amplitude is 'phase'", "number"}},
      {"motion vibrot origin 0 0 0 axis 1 0 0 order 1 amplitude 1 phase 0 period 0", {"period is 0"}},
      {"servo", {"servo: 'com' is missing"}},
      {"servo com 0 0 0 ctrlPV pressure", {"ctrlPV is 'pressure'", "'force' or 'torque'"}},
      {"servo com 0 0 0 ctrlPV force axis 0 0 1 vel_max 1", {"'target_val' is missing"}},
      {servo + " com 0 0 0", {"'com' is given twice"}},
      {"servo com 0 0 0 ctrlPV force axis 0 0 0", {"axis is 0 0 0"}},
      {"servo com 0 0 0 ctrlPV force axis 0 0 1 target_val 0 vel_max 1", {"target_val is 0"}},
      {"servo com 0 0 0 ctrlPV force axis 0 0 1 target_val 1 vel_max 0", {"vel_max is '0'", "above 0"}},
      {servo + " kp -1", {"kp is '-1'", "0 or more"}},
      {servo + " kp 0", {"kp, ki and kd are all 0"}},
      {servo + " mode manual", {"mode is 'manual'", "'auto'"}},
      {servo + " mode auto", {"'mode auto' and 'ratio'"}},
      {servo + " ratio 0.1", {"'mode auto' and 'ratio'"}},
      {"surface_vel 1 0", {"'0' is the last word", "surface_vel"}},
      {"surface_ang_vel origin 0 0 0 axis 0 0 0 omega 1", {"axis is 0 0 0"}},
      {"surface_ang_vel origin 0 0 0 axis 0 0 1 period 1", {"'period'", "'omega' is expected"}},
      {servo + " motion linear 1 0 0", {"'motion' is given beside 'servo'"}},
      {"motion linear 1 0 0 " + servo, {"'servo' is given beside 'motion'"}},
      {"surface_vel 1 0 0 surface_vel 1 0 0", {"'surface_vel' is given beside 'surface_vel'"}},
      {"surface_vel 1 0 0 motion linear 1 0 0", {"'motion' is given beside 'surface_vel'"}},
  };
  for (const WrongWords& wrong : table) {
    SCOPED_TRACE(wrong.line);
    try {
      read(wrong.line);
      ADD_FAILURE() << "expected std::invalid_argument";
    } catch (const std::invalid_argument& problem) {
      for (const std::string& part : wrong.expected) EXPECT_THAT(problem.what(), HasSubstr(part));
    }
  }
}

}  // namespace

// SPDX-License-Identifier: GPL-2.0-or-later
#include "motion_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "geometry_io/yaml_map.h"

namespace liggghts_pkg {

namespace {

using coupling::Harmonics;
using coupling::Motion;
using coupling::ServoSettings;
using coupling::Value;
using nurbs::Vector3;

[[noreturn]] void fail(const std::string& message) { throw std::invalid_argument(message); }

Vector3 keyed_vector(WordReader& words, const std::string& keyword) {
  words.expect(keyword);
  return words.vector(keyword);
}

Vector3 axis(WordReader& words) {
  const Vector3 direction = words.vector("axis");
  if (direction.isZero(0.0)) fail("axis is 0 0 0, expected a direction");
  return direction;
}

Vector3 keyed_axis(WordReader& words) {
  words.expect("axis");
  return axis(words);
}

double check_period(double period) {
  if (period == 0.0) fail("period is 0, expected a time other than 0");
  return period;
}

double keyed_period(WordReader& words) {
  words.expect("period");
  return check_period(words.number("period"));
}

constexpr int kMostHarmonics = 1000;

Harmonics keyed_harmonics(WordReader& words) {
  words.expect("order");
  const int order = words.count("order", "the number of harmonics", kMostHarmonics);
  Harmonics harmonics;
  words.expect("amplitude");
  harmonics.amplitude = words.numbers("amplitude", order);
  words.expect("phase");
  harmonics.phase = words.numbers("phase", order);
  words.expect("period");
  harmonics.period = words.numbers("period", order);
  std::for_each(harmonics.period.begin(), harmonics.period.end(), check_period);
  return harmonics;
}

struct Verb {
  const char* word;
  Motion (*read)(WordReader& words, const VariableLookup& variable);
};

// Arguments are read in the order of the words, hence the named temporaries.
const Verb kVerbs[] = {
    {"linear",
     [](WordReader& words, const VariableLookup&) { return coupling::linear(words.vector("linear")); }},
    {"linear/variable",
     [](WordReader& words, const VariableLookup& variable) {
       const Value vx = words.number_or_variable("linear/variable", variable);
       const Value vy = words.number_or_variable("linear/variable", variable);
       const Value vz = words.number_or_variable("linear/variable", variable);
       return coupling::linear_variable(vx, vy, vz);
     }},
    {"wiggle",
     [](WordReader& words, const VariableLookup&) {
       const Vector3 amplitude = keyed_vector(words, "amplitude");
       return coupling::wiggle(amplitude, keyed_period(words));
     }},
    {"riggle",
     [](WordReader& words, const VariableLookup&) {
       const Vector3 origin = keyed_vector(words, "origin"), axis = keyed_axis(words);
       const double period = keyed_period(words);
       words.expect("amplitude");
       return coupling::riggle(origin, axis, period, words.number("amplitude"));
     }},
    {"rotate",
     [](WordReader& words, const VariableLookup&) {
       const Vector3 origin = keyed_vector(words, "origin"), axis = keyed_axis(words);
       return coupling::rotate(origin, axis, keyed_period(words));
     }},
    {"rotate/variable",
     [](WordReader& words, const VariableLookup& variable) {
       const Vector3 origin = keyed_vector(words, "origin"), axis = keyed_axis(words);
       words.expect("omega");
       return coupling::rotate_variable(origin, axis, words.number_or_variable("omega", variable));
     }},
    {"viblin",
     [](WordReader& words, const VariableLookup&) {
       const Vector3 axis = keyed_axis(words);
       return coupling::viblin(axis, keyed_harmonics(words));
     }},
    {"vibrot",
     [](WordReader& words, const VariableLookup&) {
       const Vector3 origin = keyed_vector(words, "origin"), axis = keyed_axis(words);
       return coupling::vibrot(origin, axis, keyed_harmonics(words));
     }},
};

Motion read_motion(WordReader& words, const VariableLookup& variable) {
  std::vector<std::string> known;
  for (const Verb& verb : kVerbs) known.push_back(verb.word);
  const std::string given = words.value(fmt::format("one of {}", fmt::join(known, ", ")));
  for (const Verb& verb : kVerbs)
    if (given == verb.word) return verb.read(words, variable);
  const std::string near = geometry_io::nearest_word(given, known);
  fail(fmt::format("unknown motion '{}'{}, expected one of {}", given,
                   near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near), fmt::join(known, ", ")));
}

Value target_value(WordReader& words, const std::string& keyword, const VariableLookup& variable) {
  const Value target = words.number_or_variable(keyword, variable);
  if (!target.varies() && target() == 0.0)
    fail(fmt::format("{} is 0, expected a number other than 0", keyword));
  return target;
}

void check_gains(const ServoSettings& servo) {
  if (!servo.automatic && servo.kp == 0.0 && servo.ki == 0.0 && servo.kd == 0.0)
    fail("kp, ki and kd are all 0, expected at least one of them above 0");
}

ServoSettings read_servo(WordReader& words, const VariableLookup& variable) {
  static const std::vector<std::string> keywords = {"com", "ctrlPV", "axis", "target_val", "vel_max",
                                                    "kp",  "ki",     "kd",   "mode",       "ratio"};
  ServoSettings servo;
  std::vector<std::string> seen;
  bool is_automatic = false;
  double ratio = 0.0;
  while (words.next_is_one_of(keywords)) {
    const std::string keyword = words.keyword();
    if (std::find(seen.begin(), seen.end(), keyword) != seen.end())
      fail(fmt::format("keyword '{}' is given twice, expected once", keyword));
    seen.push_back(keyword);

    if (keyword == "com") servo.com = words.vector(keyword);
    if (keyword == "ctrlPV")
      servo.controls = words.value_of(keyword, {"force", "torque"}) == "force"
                           ? ServoSettings::Controls::force
                           : ServoSettings::Controls::torque;
    if (keyword == "axis") servo.axis = axis(words).normalized();
    if (keyword == "target_val") servo.target = target_value(words, keyword, variable);
    if (keyword == "vel_max") servo.vel_max = words.number_above_zero(keyword);
    if (keyword == "kp") servo.kp = words.number_at_least_zero(keyword);
    if (keyword == "ki") servo.ki = words.number_at_least_zero(keyword);
    if (keyword == "kd") servo.kd = words.number_at_least_zero(keyword);
    if (keyword == "mode") is_automatic = words.value_of(keyword, {"auto"}) == "auto";
    if (keyword == "ratio") ratio = words.number_above_zero(keyword);
  }

  for (const char* needed : {"com", "ctrlPV", "axis", "target_val", "vel_max"})
    if (std::find(seen.begin(), seen.end(), needed) == seen.end())
      fail(fmt::format("'{}' is missing, expected com, ctrlPV, axis, target_val and vel_max", needed));
  if (is_automatic != (ratio > 0.0))
    fail("'mode auto' and 'ratio' are given without each other, expected both or none");
  if (is_automatic) servo.automatic = ServoSettings::Automatic{ratio, {}, {}};
  check_gains(servo);
  return servo;
}

coupling::BeltVelocity read_belt(WordReader& words, const VariableLookup& variable) {
  coupling::BeltVelocity belt;
  for (Value& component : belt.components) component = words.number_or_variable("surface_vel", variable);
  return belt;
}

coupling::RollerVelocity read_roller(WordReader& words, const VariableLookup& variable) {
  const Vector3 origin = keyed_vector(words, "origin"), axis = keyed_axis(words);
  words.expect("omega");
  return {origin, axis, words.number_or_variable("omega", variable)};
}

void read_one(const std::string& keyword, WordReader& words, const VariableLookup& variable,
              coupling::RigidDrive& drive) {
  if (keyword == "motion") drive.motions.push_back(read_motion(words, variable));
  if (keyword == "servo") drive.servo = read_servo(words, variable);
  if (keyword == "surface_vel") drive.sliding = coupling::SlidingSurface(read_belt(words, variable));
  if (keyword == "surface_ang_vel") drive.sliding = coupling::SlidingSurface(read_roller(words, variable));
}

std::vector<Motion> read_new_motions(WordReader& words, const VariableLookup& variable) {
  std::vector<Motion> motions;
  if (words.next_is_one_of({"none"})) {
    words.keyword();
    return motions;
  }
  motions.push_back(read_motion(words, variable));
  while (words.next_is_one_of({"motion"})) {
    words.keyword();
    motions.push_back(read_motion(words, variable));
  }
  return motions;
}

void change_servo(const std::string& keyword, WordReader& words, const VariableLookup& variable,
                  coupling::Servo& servo) {
  ServoSettings& settings = servo.settings();
  if (keyword == "servo/integrate") {
    settings.integrate = words.value_of(keyword, {"start", "stop"}) == "start";
  } else if (keyword == "servo/vel_max") {
    settings.vel_max = words.number_above_zero(keyword);
  } else if (keyword == "servo/target_val") {
    settings.target = target_value(words, keyword, variable);
    servo.forget_past_errors();
  } else if (keyword == "servo/ctrlParam") {
    settings.kp = words.number_at_least_zero(keyword);
    settings.ki = words.number_at_least_zero(keyword);
    settings.kd = words.number_at_least_zero(keyword);
    check_gains(settings);
    servo.forget_past_errors();
  } else {
    if (!settings.automatic) fail("servo/ratio belongs to a servo with 'mode auto'");
    settings.automatic->ratio = words.number_above_zero(keyword);
  }
}

}  // namespace

const std::vector<std::string>& drive_keywords() {
  static const std::vector<std::string> keywords = {"motion", "servo", "surface_vel", "surface_ang_vel"};
  return keywords;
}

std::string drive_name(const coupling::RigidDrive& drive) {
  if (!drive.motions.empty()) return "motion";
  if (drive.servo) return "servo";
  return drive.sliding ? "surface_vel" : "";
}

void read_drive(const std::string& keyword, WordReader& words, const VariableLookup& variable,
                coupling::RigidDrive& drive) {
  const std::string present = drive_name(drive);
  if (!present.empty() && (keyword != "motion" || present != "motion"))
    fail(fmt::format("'{}' is given beside '{}', expected one of them (motion alone may be repeated)",
                     keyword, present == "surface_vel" ? "surface_vel' or 'surface_ang_vel" : present));
  try {
    read_one(keyword, words, variable, drive);
  } catch (const std::invalid_argument& problem) {
    fail(fmt::format("{}: {}", keyword, problem.what()));
  }
}

void change_drive(WordReader& words, const VariableLookup& variable, coupling::RigidSurface& wall) {
  static const std::vector<std::string> known = {"motion",        "servo/integrate", "servo/target_val",
                                                 "servo/vel_max", "servo/ctrlParam", "servo/ratio"};
  if (!words.next_is_one_of(known))
    fail(fmt::format("fix_modify: '{}' is unknown, expected one of {}", words.keyword(),
                     fmt::join(known, ", ")));
  const std::string keyword = words.keyword();
  if (keyword != "motion" && !wall.servo())
    fail(fmt::format("fix_modify: '{}' needs a wall with a servo", keyword));
  try {
    if (keyword == "motion")
      wall.set_motions(read_new_motions(words, variable));
    else
      change_servo(keyword, words, variable, *wall.servo());
  } catch (const std::invalid_argument& problem) {
    fail(fmt::format("fix_modify {}: {}", keyword, problem.what()));
  }
}

}  // namespace liggghts_pkg

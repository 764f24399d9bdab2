// SPDX-License-Identifier: GPL-2.0-or-later
#include "motion_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "keyword_table.h"

namespace liggghts_pkg {

namespace {

using coupling::Harmonics;
using coupling::Motion;
using coupling::ServoSettings;
using coupling::Value;
using nurbs::Vector3;

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

// Arguments are read in the order of the words, hence the named temporaries.
constexpr Keyword<Motion(WordReader&, const VariableLookup&)> kVerbs[] = {
    {"linear", "linear Vx Vy Vz",
     [](WordReader& words, const VariableLookup&) { return coupling::linear(words.vector("linear")); }},
    {"linear/variable", "linear/variable v_Vx v_Vy v_Vz",
     [](WordReader& words, const VariableLookup& variable) {
       const Value vx = words.number_or_variable("linear/variable", variable);
       const Value vy = words.number_or_variable("linear/variable", variable);
       const Value vz = words.number_or_variable("linear/variable", variable);
       return coupling::linear_variable(vx, vy, vz);
     }},
    {"wiggle", "wiggle amplitude Ax Ay Az period P",
     [](WordReader& words, const VariableLookup&) {
       const Vector3 amplitude = keyed_vector(words, "amplitude");
       return coupling::wiggle(amplitude, keyed_period(words));
     }},
    {"riggle", "riggle origin Px Py Pz axis ax ay az period P amplitude A",
     [](WordReader& words, const VariableLookup&) {
       const Vector3 origin = keyed_vector(words, "origin"), axis = keyed_axis(words);
       const double period = keyed_period(words);
       words.expect("amplitude");
       return coupling::riggle(origin, axis, period, words.number("amplitude"));
     }},
    {"rotate", "rotate origin Px Py Pz axis ax ay az period P",
     [](WordReader& words, const VariableLookup&) {
       const Vector3 origin = keyed_vector(words, "origin"), axis = keyed_axis(words);
       return coupling::rotate(origin, axis, keyed_period(words));
     }},
    {"rotate/variable", "rotate/variable origin Px Py Pz axis ax ay az omega v_omega",
     [](WordReader& words, const VariableLookup& variable) {
       const Vector3 origin = keyed_vector(words, "origin"), axis = keyed_axis(words);
       words.expect("omega");
       return coupling::rotate_variable(origin, axis, words.number_or_variable("omega", variable));
     }},
    {"viblin", "viblin axis ax ay az order n amplitude C1 ... Cn phase p1 ... pn period P1 ... Pn",
     [](WordReader& words, const VariableLookup&) {
       const Vector3 axis = keyed_axis(words);
       return coupling::viblin(axis, keyed_harmonics(words));
     }},
    {"vibrot",
     "vibrot origin Px Py Pz axis ax ay az order n amplitude C1 ... Cn phase p1 ... pn period P1 ... Pn",
     [](WordReader& words, const VariableLookup&) {
       const Vector3 origin = keyed_vector(words, "origin"), axis = keyed_axis(words);
       return coupling::vibrot(origin, axis, keyed_harmonics(words));
     }},
};

Motion read_motion(WordReader& words, const VariableLookup& variable) {
  const std::vector<std::string> known = words_of(kVerbs);
  const std::string given = words.value(fmt::format("one of {}", fmt::join(known, ", ")));
  if (const auto* verb = find_row(kVerbs, given)) return verb->read(words, variable);
  fail(unknown_word("motion", given, known));
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

/// What the rows of a servo read.
struct ServoReading {
  const std::string& keyword;
  WordReader& words;
  const VariableLookup& variable;
  ServoSettings& servo;
  bool& is_automatic;
  double& ratio;
};

constexpr Keyword<void(const ServoReading&)> kServoKeywords[] = {
    {"com", "com X Y Z", [](const ServoReading& in) { in.servo.com = in.words.vector(in.keyword); }},
    {"ctrlPV", "ctrlPV force|torque",
     [](const ServoReading& in) {
       in.servo.controls = in.words.value_of(in.keyword, {"force", "torque"}) == "force"
                               ? ServoSettings::Controls::force
                               : ServoSettings::Controls::torque;
     }},
    {"axis", "axis ax ay az", [](const ServoReading& in) { in.servo.axis = axis(in.words).normalized(); }},
    {"target_val", "target_val T",
     [](const ServoReading& in) { in.servo.target = target_value(in.words, in.keyword, in.variable); }},
    {"vel_max", "vel_max V",
     [](const ServoReading& in) { in.servo.vel_max = in.words.number_above_zero(in.keyword); }},
    {"kp", "kp k", [](const ServoReading& in) { in.servo.kp = in.words.number_at_least_zero(in.keyword); }},
    {"ki", "ki k", [](const ServoReading& in) { in.servo.ki = in.words.number_at_least_zero(in.keyword); }},
    {"kd", "kd k", [](const ServoReading& in) { in.servo.kd = in.words.number_at_least_zero(in.keyword); }},
    {"mode", "mode auto",
     [](const ServoReading& in) { in.is_automatic = in.words.value_of(in.keyword, {"auto"}) == "auto"; }},
    {"ratio", "ratio R", [](const ServoReading& in) { in.ratio = in.words.number_above_zero(in.keyword); }},
};

ServoSettings read_servo(WordReader& words, const VariableLookup& variable) {
  ServoSettings servo;
  std::vector<std::string> seen;
  bool is_automatic = false;
  double ratio = 0.0;
  while (words.next_is_one_of(words_of(kServoKeywords))) {
    const std::string keyword = words.keyword();
    if (std::find(seen.begin(), seen.end(), keyword) != seen.end())
      fail(fmt::format("keyword '{}' is given twice, expected once", keyword));
    seen.push_back(keyword);
    find_row(kServoKeywords, keyword)->read({keyword, words, variable, servo, is_automatic, ratio});
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

constexpr Keyword<void(WordReader&, const VariableLookup&, coupling::RigidDrive&)> kDrives[] = {
    {"motion", "motion VERB ...",
     [](WordReader& words, const VariableLookup& variable, coupling::RigidDrive& drive) {
       drive.motions.push_back(read_motion(words, variable));
     }},
    {"servo", "servo com X Y Z",
     [](WordReader& words, const VariableLookup& variable, coupling::RigidDrive& drive) {
       drive.servo = read_servo(words, variable);
     }},
    {"surface_vel", "surface_vel Vx Vy Vz",
     [](WordReader& words, const VariableLookup& variable, coupling::RigidDrive& drive) {
       drive.sliding = coupling::SlidingSurface(read_belt(words, variable));
     }},
    {"surface_ang_vel", "surface_ang_vel origin Px Py Pz axis ax ay az omega w",
     [](WordReader& words, const VariableLookup& variable, coupling::RigidDrive& drive) {
       drive.sliding = coupling::SlidingSurface(read_roller(words, variable));
     }},
};

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

void change_gains(WordReader& words, coupling::Servo& servo) {
  ServoSettings& settings = servo.settings();
  settings.kp = words.number_at_least_zero("servo/ctrlParam");
  settings.ki = words.number_at_least_zero("servo/ctrlParam");
  settings.kd = words.number_at_least_zero("servo/ctrlParam");
  check_gains(settings);
  servo.forget_past_errors();
}

/// What the rows of fix_modify change; all but `motion` a wall with a servo.
struct Change {
  const std::string& keyword;
  WordReader& words;
  const VariableLookup& variable;
  coupling::RigidSurface& wall;
};

constexpr Keyword<void(const Change&)> kChanges[] = {
    {"motion", "motion none",
     [](const Change& in) { in.wall.set_motions(read_new_motions(in.words, in.variable)); }},
    {"servo/integrate", "servo/integrate start|stop",
     [](const Change& in) {
       in.wall.servo()->settings().integrate = in.words.value_of(in.keyword, {"start", "stop"}) == "start";
     }},
    {"servo/target_val", "servo/target_val T",
     [](const Change& in) {
       in.wall.servo()->settings().target = target_value(in.words, in.keyword, in.variable);
       in.wall.servo()->forget_past_errors();
     }},
    {"servo/vel_max", "servo/vel_max V",
     [](const Change& in) { in.wall.servo()->settings().vel_max = in.words.number_above_zero(in.keyword); }},
    {"servo/ctrlParam", "servo/ctrlParam KP KI KD",
     [](const Change& in) { change_gains(in.words, *in.wall.servo()); }},
    {"servo/ratio", "servo/ratio R",
     [](const Change& in) {
       ServoSettings& settings = in.wall.servo()->settings();
       if (!settings.automatic) fail("servo/ratio belongs to a servo with 'mode auto'");
       settings.automatic->ratio = in.words.number_above_zero(in.keyword);
     }},
};

}  // namespace

const std::vector<std::string>& drive_keywords() {
  static const std::vector<std::string> keywords = words_of(kDrives);
  return keywords;
}

std::vector<std::string> motion_syntax() {
  std::vector<std::string> lines;
  for (const auto& table :
       {syntax_of(kDrives), syntax_of(kVerbs), syntax_of(kServoKeywords), syntax_of(kChanges)})
    lines.insert(lines.end(), table.begin(), table.end());
  return lines;
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
    find_row(kDrives, keyword)->read(words, variable, drive);
  } catch (const std::invalid_argument& problem) {
    fail(fmt::format("{}: {}", keyword, problem.what()));
  }
}

void change_drive(WordReader& words, const VariableLookup& variable, coupling::RigidSurface& wall) {
  const std::vector<std::string> known = words_of(kChanges);
  if (!words.next_is_one_of(known))
    fail(fmt::format("fix_modify: '{}' is unknown, expected one of {}", words.keyword(),
                     fmt::join(known, ", ")));
  const std::string keyword = words.keyword();
  if (keyword != "motion" && !wall.servo())
    fail(fmt::format("fix_modify: '{}' needs a wall with a servo", keyword));
  try {
    find_row(kChanges, keyword)->read({keyword, words, variable, wall});
  } catch (const std::invalid_argument& problem) {
    fail(fmt::format("fix_modify {}: {}", keyword, problem.what()));
  }
}

}  // namespace liggghts_pkg

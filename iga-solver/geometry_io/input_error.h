// SPDX-License-Identifier: GPL-2.0-or-later
// Complaints about users' files.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

namespace geometry_io {

/// Whatever the user's text holds, the message is one line.
inline std::string one_line(std::string message) {
  std::replace_if(
      message.begin(), message.end(), [](unsigned char c) { return c < ' '; }, ' ');
  return message;
}

/// What a user's file got wrong: "plate.yaml:7: material.density is -1, expected a number > 0".  One line.
struct InputError : std::runtime_error {
  explicit InputError(const std::string& message) : std::runtime_error(one_line(message)) {}
};

/// A user's text inside a message: long ones are cut.
inline std::string shown(const std::string& text) {
  constexpr size_t kLongest = 60;
  return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
}

/// Throws the InputError "file:line: message"; lines count from 1.
[[noreturn]] inline void fail_at_line(const std::string& file, int line, const std::string& message) {
  throw InputError(file + ":" + std::to_string(line) + ": " + message);
}

}  // namespace geometry_io

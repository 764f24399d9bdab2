// SPDX-License-Identifier: GPL-2.0-or-later
// CAD files that a program of this folder tries one after the other.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <string>
#include <vector>

#include "cad_wall.h"

namespace step_parts {

/// The words of a command line: files, how many points, which.
struct TriedFiles {
  TriedFiles(const std::string& what, const std::string& points_of, int points_unless_told)
      : app(what), points(points_unless_told) {
    app.add_option("files", files, "STEP or IGES")->required();
    app.add_option("--points", points, points_of);
    app.add_option("--seed", seed, "of the random numbers");
  }

  /// Parses the line and tries each file: `attempt(file)` says how much of it was wrong, an exception is one
  /// more.  The exit code.
  template <class Attempt>
  int run(int argc, char** argv, Attempt attempt) {
    CLI11_PARSE(app, argc, argv);
    long wrong = 0;
    for (const std::string& file : files) {
      try {
        fmt::print("{}: ", file);
        wrong += attempt(file);
      } catch (const std::exception& error) {
        fmt::print("{}\n", error.what());
        ++wrong;
      }
    }
    return wrong == 0 ? 0 : 1;
  }

  CLI::App app;
  std::vector<std::string> files;
  int points;
  unsigned seed = 1;
};

}  // namespace step_parts

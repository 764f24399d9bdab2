// SPDX-License-Identifier: GPL-2.0-or-later
// Feet on random walls against the judge (judge.h).  A miss is printed with what repeats it: --seed S --only
// WALL. Exit code 1 if there is any.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>

#include "trials.h"

int main(int argc, char** argv) {
  long count = 20000, misses = 0, trials = 0, feet = 0;
  unsigned seed = 1;
  int only = -1, points = 300;
  CLI::App app("Feet on random walls of triangles, judged by brute force");
  app.add_option("--count", count, "least number of points")->check(CLI::PositiveNumber);
  app.add_option("--seed", seed, "of the random numbers");
  app.add_option("--points", points, "of each wall");
  app.add_option("--only", only, "number of the one wall to repeat");
  CLI11_PARSE(app, argc, argv);
  try {
    using namespace brep::trials;
    for (int index = only < 0 ? 0 : only; trials < count; ++index) {
      Trial trial(seed, index);
      std::string wrong = trial.try_sheets();
      for (int k = 0; k < points && wrong.empty(); ++k, ++trials) {
        wrong = trial.try_point(k, feet);
        if (wrong.empty()) continue;
        ++misses;
        fmt::print("miss: --seed {} --only {} ({}), point {}: {}\n", seed, index,
                   family_name(index % kFamilies), k, wrong);
        wrong.clear();
      }
      if (!wrong.empty())
        fmt::print("miss: --seed {} --only {}: {}\n", seed, index, wrong), ++misses, ++trials;
      if (only >= 0) break;
    }
    fmt::print("{} points, {} feet, misses: {}\n", trials, feet, misses);
    return misses == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}

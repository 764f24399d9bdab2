// SPDX-License-Identifier: GPL-2.0-or-later
// Feet on random walls against the judges (judge.h, mixed_judge.h).  A miss is printed with what repeats it:
// --seed S --only WALL [--mixed | --stl] [--as KIND].  Exit code 1 if there is any.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <map>
#include <memory>

#include "mixed_trial.h"
#include "stl_trial.h"

int main(int argc, char** argv) {
  long count = 20000, misses = 0, trials = 0, feet = 0;
  unsigned seed = 1;
  int only = -1, points = 300;
  bool mixed = false, stl = false;
  brep::trials::Given given = brep::trials::Given::plainly;
  const std::map<std::string, brep::trials::Given> kinds{{"plainly", brep::trials::Given::plainly},
                                                         {"cad", brep::trials::Given::as_cad},
                                                         {"patches", brep::trials::Given::as_patches}};
  CLI::App app("Feet on random walls, judged by brute force");
  app.add_option("--count", count, "least number of points")->check(CLI::PositiveNumber);
  app.add_option("--seed", seed, "of the random numbers");
  app.add_option("--points", points, "of each wall");
  app.add_flag("--mixed", mixed, "planes, cylinders, cones, spheres and tori in place of triangles");
  app.add_flag("--stl", stl, "triangles by way of an STL file");
  app.add_option("--as", given, "trimmed faces as of a CAD file, or all of them NURBS patches")
      ->transform(CLI::CheckedTransformer(kinds));
  app.add_option("--only", only, "number of the one wall to repeat");
  CLI11_PARSE(app, argc, argv);
  try {
    using namespace brep::trials;
    for (int index = only < 0 ? 0 : only; trials < count; ++index) {
      std::unique_ptr<Trial> trial;
      if (mixed)
        trial = std::make_unique<MixedTrial>(seed, index, given);
      else if (stl)
        trial = stl_trial(seed, index);
      else
        trial = std::make_unique<TriangleTrial>(seed, index, given);
      const std::string what = fmt::format(
          "miss: {}{}--seed {} --only {} ({})",
          mixed ? "--mixed "
          : stl ? "--stl "
                : "",
          given == Given::as_cad       ? "--as cad "
          : given == Given::as_patches ? "--as patches "
                                       : "",
          seed, index, mixed ? mixed_family_name(index % kMixedFamilies) : family_name(index % kFamilies));
      std::string wrong = trial->try_sheets();
      for (int k = 0; k < points && wrong.empty(); ++k, ++trials) {
        wrong = trial->try_point(k, feet);
        if (wrong.empty()) continue;
        ++misses;
        fmt::print("{}, point {}: {}\n", what, k, wrong);
        wrong.clear();
      }
      if (!wrong.empty()) fmt::print("{}: {}\n", what, wrong), ++misses, ++trials;
      if (only >= 0) break;
    }
    fmt::print("{} points, {} feet, misses: {}\n", trials, feet, misses);
    return misses == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}

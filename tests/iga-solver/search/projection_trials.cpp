// SPDX-License-Identifier: GPL-2.0-or-later
// Closest-point searches tried on random surfaces and judged by distance_bound.h.
//   cold     the distance is the least there is, to 1e-9; scaling everything by 1e-3, or moving it by 1e3
//            elements, leaves it as it is; where the minimum is isolated its foot is right, too;
//   cold_on  the same distance, on the elements that a box tree finds within reach;
//   nearest  the same distance, from a guess;
//   warm     from a guess off by 1 % of an element to several elements: a local minimum, not above the guess;
//   batch    warm_batch with all points of a surface: to the last bit what warm gives each.
// A miss is printed with what repeats it: --seed S --only SURFACE.  Exit code 1 if there is any.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <exception>
#include <limits>
#include <map>

#include "distance_bound.h"
#include "feet.h"
#include "search/surface_tree.h"
#include "trial_surfaces.h"

namespace search {
namespace {

using namespace nurbs;
using namespace nurbs::trials;

constexpr double kTolerance = 1e-9;  // of distances, relative

// A projector that owns its surface.
struct Projector {
  explicit Projector(Surface given)
      : surface(std::move(given)), search(surface.space, surface.control_points), tree(surface.space) {
    tree.refit(surface.control_points);
  }
  Surface surface;
  SurfaceProjector search;
  SurfaceTree tree;
};

Surface transformed(const Surface& surface, double scale, const Vector3& shift) {
  return {surface.space, (scale * surface.control_points).colwise() + shift};
}

struct Counts {
  long trials = 0, isolated = 0, cold_misses = 0, warm_misses = 0, nets = 0;
};

// One surface, the same scaled and moved, and the searches on each.
class Trial {
 public:
  Trial(TrialSurface trial, const Vector3& shift)
      : trial_(std::move(trial)),
        shift_(shift),
        judge_(trial_.surface),
        as_given_(trial_.surface),
        scaled_(transformed(trial_.surface, kScale, Vector3::Zero())),
        moved_(transformed(trial_.surface, 1.0, shift)),
        moved_round_off_(judge::DistanceBound(moved_.surface).round_off()) {}

  const TrialSurface& surface() const { return trial_; }

  /// What is wrong with the cold search, or an empty text.
  std::string try_cold(const Vector3& d, Counts& counts) const {
    const Foot p = as_given_.search.cold(d);
    if (std::string wrong = inconsistent(d, p); !wrong.empty()) return wrong;
    if (std::string wrong = not_least(d, p, counts); !wrong.empty()) return wrong;
    const double scaled = scaled_.search.cold(kScale * d).distance / kScale;
    if (std::abs(scaled - p.distance) > kTolerance * p.distance + 2.0 * judge_.round_off())
      return fmt::format("distance {:.16g}, scaled by 1e-3 it is {:.16g}", p.distance, scaled);
    const double moved = moved_.search.cold(d + shift_).distance;
    if (std::abs(moved - p.distance) > kTolerance * p.distance + 2.0 * moved_round_off_)
      return fmt::format("distance {:.16g}, moved by 1e3 elements it is {:.16g}", p.distance, moved);
    return no_minimum(d, p, counts);
  }

  /// The same for the cold search on candidates, as contact lists hold them: those within a reach.
  std::string try_cold_on(const Vector3& d) const {
    const double nearest = as_given_.search.cold(d).distance;
    std::vector<int> candidates;
    as_given_.tree.query(d, 1.2 * nearest + 0.1 * trial_.element, 0, candidates);
    const Foot p = as_given_.search.cold_on(d, candidates.data(), static_cast<int>(candidates.size()));
    if (std::string wrong = inconsistent(d, p); !wrong.empty()) return wrong;
    if (std::abs(p.distance - nearest) > kTolerance * nearest + judge_.round_off())
      return fmt::format("distance {:.16g}, on all elements it is {:.16g}", p.distance, nearest);
    Counts not_counted;
    return no_minimum(d, p, not_counted);
  }

  /// The same for the warm search that goes on to the nearest.
  std::string try_nearest(const Vector3& d, const Parameter<2>& guess, Counts& counts) const {
    const Foot p = as_given_.search.nearest(d, guess);
    if (std::string wrong = inconsistent(d, p); !wrong.empty()) return wrong;
    return not_least(d, p, counts);
  }

  /// The same for the warm search from `guess`.
  std::string try_warm(const Vector3& d, const Parameter<2>& guess) const {
    const Foot p = as_given_.search.warm(d, guess);
    if (std::string wrong = inconsistent(d, p); !wrong.empty()) return wrong;
    const double start = (judge_.point(guess) - d).norm();
    if (p.distance > start + judge_.round_off() + 1e-15 * start)
      return fmt::format("distance {:.16g}, that of the guess {:.16g}", p.distance, start);
    Counts not_counted;
    return no_minimum(d, p, not_counted);
  }

  /// The same for the warm searches together; `number` is that of the point in question.
  std::string try_batch(const std::vector<Vector3>& d, const std::vector<Parameter<2>>& guesses,
                        int& number) const {
    const std::vector<Foot> batch = closest_from(as_given_.search, d, guesses);
    for (number = 0; number < static_cast<int>(d.size()); ++number) {
      const Foot &p = batch[number], one = as_given_.search.warm(d[number], guesses[number]);
      if (p.distance != one.distance || p.point != one.point || p.xi != one.xi || p.status != one.status ||
          p.iterations != one.iterations)
        return fmt::format("distance {:.16g} at [{}, {}], alone {:.16g} at [{}, {}]", p.distance, p.xi[0],
                           p.xi[1], one.distance, one.xi[0], one.xi[1]);
    }
    return {};
  }

  Parameter<2> foot(const Vector3& d) const { return as_given_.search.cold(d).xi; }

 private:
  std::string inconsistent(const Vector3& d, const Foot& p) const {
    if (p.status == FootStatus::not_converged) return "not converged";
    const double apart = (judge_.point(p.xi) - p.point).norm();
    if (!(apart <= judge_.round_off() + 1e-15 * p.distance))
      return fmt::format("the foot is {:.3g} elements from its parameters", apart / trial_.element);
    if (!(std::abs((d - p.point).norm() - p.distance) <= judge_.round_off()))
      return "the distance is not that of the foot";
    if (borders(p.xi) > static_cast<int>(p.status))
      return "the status does not say that the foot is on an edge";
    return {};
  }

  std::string not_least(const Vector3& d, const Foot& p, Counts& counts) const {
    if (d == judged_ && p.distance <= (1.0 + 1e-13) * least_) return {};
    const judge::Nearest nearest = judge_.nearest(d, {p.xi, p.distance, 0}, kTolerance);
    counts.nets += nearest.nets;
    judged_ = d;
    least_ = nearest.distance;
    if (nearest.distance < (1.0 - kTolerance) * p.distance - judge_.round_off())
      return fmt::format("distance {:.16g} at [{}, {}], but {:.16g} at [{}, {}]", p.distance, p.xi[0],
                         p.xi[1], nearest.distance, nearest.xi[0], nearest.xi[1]);
    return {};
  }

  // 0 inside the patch, 1 on an edge, 2 on a corner, as FootStatus counts.
  int borders(const Parameter<2>& xi) const {
    int count = 0;
    for (int i = 0; i < 2; ++i) {
      const KnotVector& knots = trial_.surface.space.knots(i);
      if (xi[i] == knots.front() || xi[i] == knots.back()) ++count;
    }
    return count;
  }

  std::string no_minimum(const Vector3& d, const Foot& p, Counts& counts) const {
    constexpr double kIsolated = 1e-2;
    const judge::LocalConditions at = judge_.conditions(d, p.xi);
    const double round_off = judge_.round_off() + 1e-14 * p.distance;
    if (at.slope < -1e-7 * p.distance - round_off ||
        at.curvature < -1e-6 * (1.0 + p.distance / trial_.element))
      return fmt::format("no minimum at [{}, {}], distance {:.16g}: slope {:.3g}, curvature {:.3g}", p.xi[0],
                         p.xi[1], p.distance, at.slope, at.curvature);
    if (at.curvature < kIsolated) return {};
    ++counts.isolated;
    if (-at.slope > 1e-8 * at.curvature * trial_.element + round_off)
      return fmt::format("foot off by {:.3g} elements", -at.slope / at.curvature / trial_.element);
    return {};
  }

  static constexpr double kScale = 1e-3;
  TrialSurface trial_;
  Vector3 shift_;
  judge::DistanceBound judge_;
  Projector as_given_, scaled_, moved_;
  double moved_round_off_;
  // What the judge said last: where all of a circle is nearest, it takes tens of thousands of nets to say so.
  mutable Vector3 judged_ = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  mutable double least_ = 0.0;
};

class Trials {
 public:
  explicit Trials(unsigned seed) : seed_(seed) {}

  // Every surface has its own random numbers, so that it can be repeated alone.
  void run_surface(int index) {
    constexpr int kPointsPerPlace = 5;
    constexpr double kOff[] = {0.01, 0.1, 0.5, 1.5, 4.0};  // elements
    std::seed_seq seeds{seed_, static_cast<unsigned>(index)};
    shapes::Random random(seeds);
    TrialSurface surface = random_surface(random, static_cast<Family>(index % kFamilies));
    const Vector3 shift = 1e3 * surface.element * Vector3(0.6, -0.64, 0.48);
    const Trial trial(std::move(surface), shift);
    std::vector<Vector3> points;
    std::vector<Parameter<2>> guesses;
    for (int k = 0; k < kPlaces * kPointsPerPlace; ++k) {
      const Place place = static_cast<Place>(k % kPlaces);
      const Vector3 d = random_point(random, trial.surface(), place);
      Counts& counts = counts_[index % kFamilies][k % kPlaces];
      ++counts.trials;
      report(index, k, "cold", trial.try_cold(d, counts), counts.cold_misses);
      report(index, k, "cold_on", trial.try_cold_on(d), counts.cold_misses);
      const Parameter<2> guess =
          guess_beside(random, trial.surface().surface.space, trial.foot(d), kOff[k / kPlaces]);
      report(index, k, "nearest", trial.try_nearest(d, guess, counts), counts.cold_misses);
      report(index, k, "warm", trial.try_warm(d, guess), counts.warm_misses);
      points.push_back(d);
      guesses.push_back(guess);
    }
    int k = 0;
    const std::string wrong = trial.try_batch(points, guesses, k);
    report(index, k, "batch", wrong, counts_[index % kFamilies][k % kPlaces].warm_misses);
  }

  long trials() const { return total().trials; }

  /// Prints the counts; the number of misses.
  long summarise() const {
    fmt::print("{:8} {:7} {:>9} {:>9} {:>6} {:>6} {:>10}\n", "surface", "point", "trials", "isolated", "cold",
               "warm", "nets each");
    for (int f = 0; f < kFamilies; ++f)
      for (int k = 0; k < kPlaces; ++k)
        row(name(static_cast<Family>(f)), name(static_cast<Place>(k)), counts_[f][k]);
    const Counts sum = total();
    row("all", "", sum);
    const long misses = sum.cold_misses + sum.warm_misses;
    fmt::print("misses: {}\n", misses);
    return misses;
  }

 private:
  void report(int index, int k, const char* search, const std::string& wrong, long& misses) const {
    if (wrong.empty()) return;
    ++misses;
    fmt::print("miss: --seed {} --only {}, point {} ({}, {}), {}: {}\n", seed_, index, k,
               name(static_cast<Family>(index % kFamilies)), name(static_cast<Place>(k % kPlaces)), search,
               wrong);
  }

  static void row(const char* family, const char* place, const Counts& c) {
    fmt::print("{:8} {:7} {:9} {:9} {:6} {:6} {:10.1f}\n", family, place, c.trials, c.isolated, c.cold_misses,
               c.warm_misses, static_cast<double>(c.nets) / static_cast<double>(c.trials));
  }

  Counts total() const {
    Counts sum;
    for (const auto& family : counts_)
      for (const Counts& c : family) {
        sum.trials += c.trials;
        sum.isolated += c.isolated;
        sum.cold_misses += c.cold_misses;
        sum.warm_misses += c.warm_misses;
        sum.nets += c.nets;
      }
    return sum;
  }

  unsigned seed_;
  Counts counts_[kFamilies][kPlaces];
};

}  // namespace
}  // namespace search

int main(int argc, char** argv) {
  long count = 100000;
  unsigned seed = 1;
  int only = -1, family = -1;
  CLI::App app("Closest-point searches on random surfaces, judged by subdivision with lower bounds");
  app.add_option("--count", count, "least number of trials")->check(CLI::PositiveNumber);
  app.add_option("--seed", seed, "of the random numbers");
  app.add_option("--only", only, "number of the one surface to repeat");
  std::map<std::string, int> families;
  for (int f = 0; f < nurbs::trials::kFamilies; ++f)
    families[name(static_cast<nurbs::trials::Family>(f))] = f;
  app.add_option("--family", family, "surfaces of this family alone")->transform(CLI::Transformer(families));
  CLI11_PARSE(app, argc, argv);
  try {
    search::Trials trials(seed);
    if (only >= 0)
      trials.run_surface(only);
    else
      for (int index = 0; trials.trials() < count; ++index)
        if (family < 0 || index % nurbs::trials::kFamilies == family) trials.run_surface(index);
    return trials.summarise() == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}

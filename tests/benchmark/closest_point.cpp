// SPDX-License-Identifier: GPL-2.0-or-later
// Times the closest-point search, the rebuild of its elements and the distribution of contact forces, beside
// other codes on the same surfaces and points.  Names are WHAT/METHOD/SURFACE/N for N x N elements; one
// iteration is one point, element or contact.  The counter `right` is the fraction of all points whose foot
// is within 1e-6 of an element.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "coupling/force_distribution.h"
#include "opencascade.h"
#include "search/simplex_brent.h"
#include "search/surface_projector.h"
#include "surfaces.h"

namespace benchmarks {
namespace {

using nurbs::SimdLevel;
using nurbs::Vector3;

/// Instruction set that our code was compiled for, but for the kernels chosen at run time.
#if defined(__AVX512F__)
constexpr const char* kCompiledFor = "AVX-512";
#elif defined(__AVX2__)
constexpr const char* kCompiledFor = "AVX2";
#else
constexpr const char* kCompiledFor = "the compiler's portable default";
#endif

constexpr int kPoints = 20000;
constexpr int kBatch = 100;  // points between two looks at the clock

struct Case {
  Case(const std::string& name, int n)
      : label("/" + name + "/" + std::to_string(n)),
        n(n),
        surface(make_surface(name, n)),
        queries(make_queries(surface, kPoints)),
        ours(surface.space, surface.control_points),
        opencascade(surface) {
    for (const Query& query : queries) points.push_back(query.d), guesses.push_back(query.guess);
  }

  std::string label;
  int n;
  nurbs::Surface surface;
  std::vector<Query> queries;
  std::vector<Vector3> points;
  std::vector<nurbs::Parameter<2>> guesses;
  search::SurfaceProjector ours;
  std::vector<std::unique_ptr<search::SurfaceProjector>> levels;
  OpenCascade opencascade;
};

template <class Search>
double fraction_right(const Case& c, const Search& search) {
  int right = 0;
  for (const Query& query : c.queries) right += (search(query) - query.foot).norm() <= 1e-6 / c.n;
  return right / double(c.queries.size());
}

/// `search` gives the foot of a query.  Checked when first run, before any timing.
template <class Search>
void add_search(Case& c, const std::string& name, Search search) {
  auto right = std::make_shared<std::optional<double>>();
  benchmark::RegisterBenchmark((name + c.label).c_str(), [&c, right, search](benchmark::State& state) {
    if (!*right) *right = fraction_right(c, search);
    size_t i = 0;
    while (state.KeepRunningBatch(kBatch))
      for (int k = 0; k < kBatch; ++k) {
        benchmark::DoNotOptimize(search(c.queries[i]));
        if (++i == c.queries.size()) i = 0;
      }
    state.counters["right"] = **right;
  });
}

/// Warm feet one by one, as a loop over contacts finds them: the start of the next while this one is
/// searched.
void add_warm(Case& c, const std::string& name, const search::SurfaceProjector& ours) {
  auto right = std::make_shared<std::optional<double>>();
  benchmark::RegisterBenchmark((name + c.label).c_str(), [&c, &ours, right](benchmark::State& state) {
    if (!*right) *right = fraction_right(c, [&](const Query& q) { return ours.warm(q.d, q.guess).point; });
    size_t i = 0;
    search::SurfaceProjector::Start start = ours.start(c.queries[0].guess);
    while (state.KeepRunningBatch(kBatch))
      for (int k = 0; k < kBatch; ++k) {
        const Query& query = c.queries[i];
        if (++i == c.queries.size()) i = 0;
        const search::SurfaceProjector::Start next = ours.start(c.queries[i].guess);
        benchmark::DoNotOptimize(ours.warm_from(query.d, start).point);
        start = next;
      }
    state.counters["right"] = **right;
  });
}

/// Feet of kBatch points at a time, each from its guess.
class Batch {
 public:
  Batch() {
    for (int k = 0; k < kBatch; ++k) places_[k] = &feet_[k];
  }
  /// Those of the points from number `first` on.
  const search::Foot* feet(const Case& c, const search::SurfaceProjector& ours, int first) {
    for (int k = 0; k < kBatch; ++k) feet_[k].xi = c.guesses[first + k];
    ours.warm_batch(&c.points[first], places_, kBatch);
    return feet_;
  }

 private:
  search::Foot feet_[kBatch], *places_[kBatch];
};

void add_batch(Case& c, const std::string& name, const search::SurfaceProjector& ours) {
  auto right = std::make_shared<std::optional<double>>();
  benchmark::RegisterBenchmark((name + c.label).c_str(), [&c, &ours, right](benchmark::State& state) {
    Batch batch;
    const search::Foot* feet = nullptr;
    if (!*right)
      *right = fraction_right(c, [&](const Query& q) {
        const auto number = static_cast<int>(&q - c.queries.data());
        if (number % kBatch == 0) feet = batch.feet(c, ours, number);
        return feet[number % kBatch].point;
      });
    int i = 0;
    while (state.KeepRunningBatch(kBatch)) {
      benchmark::DoNotOptimize(batch.feet(c, ours, i));
      if ((i += kBatch) == kPoints) i = 0;
    }
    state.counters["right"] = **right;
  });
}

/// The warm search with every instruction set that this machine has.
void add_levels(Case& c) {
  for (const SimdLevel level : {SimdLevel::portable, SimdLevel::avx2, SimdLevel::avx512}) {
    if (!nurbs::available(level)) continue;
    c.levels.push_back(
        std::make_unique<search::SurfaceProjector>(c.surface.space, c.surface.control_points, level));
    const search::SurfaceProjector& ours = *c.levels.back();
    add_warm(c, std::string("warm/") + nurbs::name(level), ours);
    add_batch(c, std::string("batch/") + nurbs::name(level), ours);
  }
}

void add_searches(Case& c) {
  add_warm(c, "warm/ours", c.ours);
  add_search(c, "warm_call/ours", [&c](const Query& q) { return c.ours.warm(q.d, q.guess).point; });
  add_batch(c, "batch/ours", c.ours);
  add_search(c, "nearest/ours", [&c](const Query& q) { return c.ours.nearest(q.d, q.guess).point; });
  add_search(c, "warm/opencascade", [&c](const Query& q) { return c.opencascade.warm(q.d, q.guess); });
  add_search(c, "warm/simplex_brent", [&c](const Query& q) {
    return search::closest_point_simplex_brent(c.surface.space, c.surface.control_points, q.d, q.guess, true)
        .point;
  });
  add_search(c, "cold/ours", [&c](const Query& q) { return c.ours.cold(q.d).point; });
  add_search(c, "cold/opencascade", [&c](const Query& q) { return c.opencascade.cold(q.d); });
}

/// Power form of all elements; the projector does the same, for each element when it is first used.
void add_rebuild(Case& c) {
  benchmark::RegisterBenchmark(("rebuild/ours" + c.label).c_str(), [&c](benchmark::State& state) {
    search::ElementStore elements(c.surface.space, c.surface.control_points);
    while (state.KeepRunningBatch(c.surface.space.element_count())) {
      elements.surface_moved();
      for (int j = 0; j < c.n; ++j)
        for (int i = 0; i < c.n; ++i) benchmark::DoNotOptimize(elements.element({i, j}).row);
    }
  });
}

/// Boxes of all elements and their tree, which the first cold search brings up to date.
void add_refit(Case& c) {
  benchmark::RegisterBenchmark(("refit/ours" + c.label).c_str(), [&c](benchmark::State& state) {
    while (state.KeepRunningBatch(c.surface.space.element_count())) {
      c.ours.surface_moved();
      benchmark::DoNotOptimize(c.ours.cold(c.queries.front().d));
    }
  });
}

void add_distribution(Case& c) {
  benchmark::RegisterBenchmark(("distribution/ours" + c.label).c_str(), [&c](benchmark::State& state) {
    nurbs::NodalVectors f = nurbs::NodalVectors::Zero(3, c.surface.space.control_point_count());
    size_t i = 0;
    while (state.KeepRunningBatch(kBatch))
      for (int k = 0; k < kBatch; ++k) {
        const Query& query = c.queries[i];
        coupling::FootBasis(c.surface.space, query.guess).distribute(query.d - query.foot, f);
        if (++i == c.queries.size()) i = 0;
      }
    benchmark::DoNotOptimize(f.data());
  });
}

/// All that a step of a run does for its contacts: the surface has moved, every contact's foot is found again
/// from the last one, and its force goes to the control points.
void add_steps(Case& c) {
  benchmark::RegisterBenchmark(("step/ours" + c.label).c_str(), [&c](benchmark::State& state) {
    nurbs::NodalVectors f(3, c.surface.space.control_point_count());
    while (state.KeepRunningBatch(kPoints)) {
      c.ours.surface_moved();
      f.setZero();
      search::SurfaceProjector::Start start = c.ours.start(c.queries[0].guess);
      for (size_t i = 0; i < c.queries.size(); ++i) {
        const Query &query = c.queries[i], &after = c.queries[std::min(i + 1, c.queries.size() - 1)];
        const search::SurfaceProjector::Start next = c.ours.start(after.guess);
        const search::Foot contact = c.ours.warm_from(query.d, start);
        coupling::FootBasis(c.surface.space, contact.xi).distribute(contact.point - query.d, f);
        start = next;
      }
      benchmark::DoNotOptimize(f.data());
    }
  });
  benchmark::RegisterBenchmark(("step_batch/ours" + c.label).c_str(), [&c](benchmark::State& state) {
    nurbs::NodalVectors f(3, c.surface.space.control_point_count());
    Batch batch;
    while (state.KeepRunningBatch(kPoints)) {
      c.ours.surface_moved();
      f.setZero();
      for (int i = 0; i < kPoints; i += kBatch) {
        const search::Foot* feet = batch.feet(c, c.ours, i);
        for (int k = 0; k < kBatch; ++k)
          coupling::FootBasis(c.surface.space, feet[k].xi).distribute(feet[k].point - c.points[i + k], f);
      }
      benchmark::DoNotOptimize(f.data());
    }
  });
}

}  // namespace
}  // namespace benchmarks

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  benchmark::AddCustomContext("compiled_for", benchmarks::kCompiledFor);
  benchmark::AddCustomContext("dispatched_to", nurbs::name(nurbs::simd_level()));
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  std::vector<std::unique_ptr<benchmarks::Case>> cases;
  for (int n : {31, 124})
    for (const char* name : {"plate", "wavy", "cylinder", "saddle", "rippled"}) {
      benchmarks::Case& c = *cases.emplace_back(std::make_unique<benchmarks::Case>(name, n));
      benchmarks::add_searches(c);
      benchmarks::add_rebuild(c);
      benchmarks::add_refit(c);
      benchmarks::add_distribution(c);
      benchmarks::add_steps(c);
      benchmarks::add_levels(c);
    }
  benchmark::RunSpecifiedBenchmarks();
}

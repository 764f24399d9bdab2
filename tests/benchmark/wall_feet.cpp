// SPDX-License-Identifier: GPL-2.0-or-later
// Feet on walls of faces: a plane, a cylinder, a sphere, fields of triangles.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "brep/builder.h"
#include "brep/foot_search.h"

namespace {

using namespace brep;

constexpr int kPoints = 1000;

// Points beside a wall with their lists of pieces, as a contact loop holds them.
struct Particles {
  Particles(const Surface& surface, double radius, double overlap, const std::vector<Vector3>& at)
      : search(surface), radius(radius) {
    for (const Vector3& d : at) {
      points.push_back(d);
      std::vector<int> list;
      search.near(d, 1.3 * radius, list);
      std::vector<int> active(list.size());
      active.resize(
          search.activate(d, radius + overlap, list.data(), static_cast<int>(list.size()), active.data()));
      lists.push_back(list);
      actives.push_back(active);
    }
  }
  void run(benchmark::State& state, const std::vector<std::vector<int>>& which) const {
    std::vector<Foot> feet;
    feet.reserve(100);
    size_t k = 0, pieces = 0, found = 0;
    for ([[maybe_unused]] auto _ : state) {
      feet.clear();
      search.feet(points[k], radius, which[k].data(), static_cast<int>(which[k].size()), feet);
      benchmark::DoNotOptimize(feet.data());
      pieces += which[k].size(), found += feet.size();
      k = k + 1 < points.size() ? k + 1 : 0;
    }
    state.counters["pieces"] = static_cast<double>(pieces) / static_cast<double>(state.iterations());
    state.counters["feet"] = static_cast<double>(found) / static_cast<double>(state.iterations());
  }

  FootSearch search;
  double radius;
  std::vector<Vector3> points;
  std::vector<std::vector<int>> lists, actives;
};

// Points at (1 - 0.01) of `radius` above heights of a square.
template <class Height>
std::vector<Vector3> above(double radius, Height height) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.1, 0.9);
  std::vector<Vector3> points;
  for (int k = 0; k < kPoints; ++k) {
    const double x = share(random), y = share(random);
    points.emplace_back(x, y, height(x, y) + 0.99 * radius);
  }
  return points;
}

double waves(double x, double y) { return 0.05 * std::sin(7.0 * x) * std::cos(5.0 * y); }

Surface field(int n) {
  NodalVectors points(3, (n + 1) * (n + 1));
  std::vector<int> triangles;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
      points.col(i + (n + 1) * j) = Vector3(x, y, waves(x, y));
      const int a = i + (n + 1) * j;
      if (i < n && j < n) triangles.insert(triangles.end(), {a, a + 1, a + n + 2, a, a + n + 2, a + n + 1});
    }
  return from_triangles(points, triangles);
}

void one_face(benchmark::State& state, const Face& face, const std::vector<Vector3>& points, double radius) {
  const Surface surface = from_faces({face});
  const Particles particles(surface, radius, 0.1 * radius, points);
  particles.run(state, particles.actives);
}

void plane(benchmark::State& state) {
  Face face;
  face.low = {-1.0, -2.0}, face.high = {2.0, 1.5};
  one_face(state, face, above(0.01, [](double, double) { return 0.0; }), 0.01);
}
BENCHMARK(plane);

void cylinder(benchmark::State& state) {
  Face face;
  face.kind = Kind::cylinder;
  face.R = 2.0;
  face.low = {0.0, -1.0}, face.high = {2.0 * std::acos(-1.0), 1.0};
  auto points = above(0.01, [](double, double) { return 0.0; });
  for (Vector3& d : points) d = Vector3(1.99 * std::cos(6.0 * d[0]), 1.99 * std::sin(6.0 * d[0]), d[1] - 0.5);
  one_face(state, face, points, 0.0102);
}
BENCHMARK(cylinder);

void sphere(benchmark::State& state) {
  Face face;
  face.kind = Kind::sphere;
  face.R = 2.0;
  face.low = {0.0, -0.5 * std::acos(-1.0)}, face.high = {2.0 * std::acos(-1.0), 0.5 * std::acos(-1.0)};
  auto points = above(0.01, [](double, double) { return 0.0; });
  for (Vector3& d : points) d = 1.99 * (d - Vector3(0.5, 0.5, 0.3)).normalized();
  one_face(state, face, points, 0.0102);
}
BENCHMARK(sphere);

// Triangles of 1 / n, particles of this many hundredths of them.
void triangles(benchmark::State& state, bool active) {
  const int n = static_cast<int>(state.range(0));
  const double radius = 0.01 * static_cast<double>(state.range(1)) / n;
  const Surface surface = field(n);
  const Particles particles(surface, radius, 0.05 * radius, above(radius, waves));
  particles.run(state, active ? particles.actives : particles.lists);
}
void from_list(benchmark::State& state) { triangles(state, false); }
void from_active(benchmark::State& state) { triangles(state, true); }
BENCHMARK(from_list)->Args({28, 50})->Args({28, 200})->Args({124, 50})->Args({124, 200});
BENCHMARK(from_active)->Args({28, 50})->Args({28, 200})->Args({124, 50})->Args({124, 200});

void build(benchmark::State& state) {
  for ([[maybe_unused]] auto _ : state) {
    const Surface surface = field(static_cast<int>(state.range(0)));
    const FootSearch search(surface);
    benchmark::DoNotOptimize(&search);
  }
}
BENCHMARK(build)->Arg(28)->Arg(124)->Arg(248)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();

// SPDX-License-Identifier: GPL-2.0-or-later
// What tables of local compliances take.  One JSON object; the time is that of this thread.
//   local_compliances BODY DEGREE [COUNT]      31 x 31 x 4 elements, of the whole top or of COUNT of it
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>

#include "cpu_seconds.h"
#include "structure/compliance/compliance_tables.h"
#include "structure/material/laws.h"
#include "structure/weld.h"
#include "volumes.h"

namespace benchmarks {
namespace {

constexpr std::array<int, 3> kElements = {31, 31, 4};
constexpr int kOnTop = kElements[0] * kElements[1];

/// Longest over shortest edge of the elements, at most.
double largest_aspect(const nurbs::Volume& volume) {
  double largest = 0.0;
  for (int e = 0; e < volume.space.element_count(); ++e) {
    const nurbs::Indices<3> span = volume.space.element_indices(e);
    const auto corner = [&](int c) {
      nurbs::Parameter<3> xi;
      for (int d = 0; d < 3; ++d) xi[d] = volume.space.knots(d).breaks()[span[d] + (c >> d & 1)];
      return nurbs::interpolate(volume.space, volume.control_points, xi);
    };
    double shortest_edge = 1e300, longest_edge = 0.0;
    for (int c = 0; c < 8; ++c)
      for (int d = 0; d < 3; ++d) {
        const double edge = (corner(c) - corner(c ^ 1 << d)).norm();
        shortest_edge = std::min(shortest_edge, edge);
        longest_edge = std::max(longest_edge, edge);
      }
    largest = std::max(largest, longest_edge / shortest_edge);
  }
  return largest;
}

void measure(const std::string& body, int degree, int count) {
  const nurbs::Volume volume = make_volume(body, kElements, degree);
  const auto steel = std::make_shared<structure::LinearElastic>(210.6e9, 0.286, 7850.0);
  structure::ComplianceTables tables({{volume}, {steel}, structure::without_welds({volume})},
                                     {{0, nurbs::Face::zeta_plus}}, true);
  const int first = count < kOnTop ? (kOnTop - count) / 2 : 0;
  double largest = 0.0;
  const double seconds = cpu_seconds([&] {
    for (int element = first; element < first + count; ++element)
      largest = std::max(largest, tables.of(0, element).largest_normal());
  });
  fmt::print(
      R"({{"body": "{}", "degree": {}, "largest_aspect": {:.4g}, "tables": {}, "largest_compliance": {:.16g}, )"
      R"("seconds": {:.6g}, "ms_per_table": {:.6g}, "seconds_of_all": {:.6g}}})"
      "\n",
      body, degree, largest_aspect(volume), tables.solved(), largest, seconds,
      1e3 * seconds / tables.solved(), seconds / tables.solved() * kOnTop);
}

}  // namespace
}  // namespace benchmarks

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4) {
    fmt::print(stderr, "usage: local_compliances plate|distorted|rational 2|3 [COUNT]\n");
    return 2;
  }
  using benchmarks::kOnTop;
  try {
    const int count = argc > 3 ? std::clamp(std::atoi(argv[3]), 1, kOnTop) : kOnTop;
    benchmarks::measure(argv[1], std::atoi(argv[2]), count);
  } catch (const std::exception& problem) {
    fmt::print(stderr, "{}\n", problem.what());
    return 1;
  }
}

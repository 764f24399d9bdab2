// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/flat_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "structure/compliance/alike_elements.h"
#include "structure/compliance/hit_element.h"
#include "structure/compliance/local_problem.h"

namespace structure {

namespace {

/// How far elements are from one of them along one direction, and whether they go on to the patch's ends.
struct Line {
  std::vector<double> distances;  ///< that one included, in any order
  int cuts = 0;                   ///< ends where others follow
};

Vector3 at(const nurbs::Volume& patch, int direction, nurbs::Parameter<3> xi, double break_) {
  xi[direction] = break_;
  return nurbs::interpolate(patch.space, patch.control_points, xi);
}

Line line(const nurbs::Volume& patch, const nurbs::Parameter<3>& centre, int direction, int span, int layers,
          double reach) {
  const std::vector<double>& breaks = patch.space.knots(direction).breaks();
  const int count = static_cast<int>(breaks.size()) - 1;
  Line line{{0.0}};
  for (const int way : {-1, 1}) {
    double distance = 0.0;
    int layer = 1, element = span + way;
    Vector3 last = at(patch, direction, centre, breaks[way < 0 ? span : span + 1]);
    for (; element >= 0 && element < count && (layer <= layers || distance < reach);
         ++layer, element += way) {
      line.distances.push_back(layer <= layers ? 0.0 : distance);
      const Vector3 next = at(patch, direction, centre, breaks[way < 0 ? element : element + 1]);
      distance += (next - last).norm();
      last = next;
    }
    if (element >= 0 && element < count) ++line.cuts;
  }
  return line;
}

double longest_side(const nurbs::Volume& patch, const nurbs::Parameter<3>& centre,
                    const nurbs::Indices<3>& span) {
  double longest = 0.0;
  for (int d = 0; d < 3; ++d) {
    const std::vector<double>& breaks = patch.space.knots(d).breaks();
    longest = std::max(
        longest, (at(patch, d, centre, breaks[span[d] + 1]) - at(patch, d, centre, breaks[span[d]])).norm());
  }
  return longest;
}

}  // namespace

double unknowns_about(const nurbs::Volume& patch, int element, const LocalExtent& extent) {
  const nurbs::Space<3>& space = patch.space;
  const nurbs::Indices<3> span = space.element_indices(element);
  const nurbs::Parameter<3> centre = space.element_centre(element);
  const double reach = extent.layers * extent.reach * longest_side(patch, centre, span);
  std::array<Line, 3> lines;
  double nodes_of_an_element = 1.0;
  for (int d = 0; d < 3; ++d) {
    lines[d] = line(patch, centre, d, span[d], extent.layers, reach);
    const double count = static_cast<double>(lines[d].distances.size());
    nodes_of_an_element *= std::max(count + space.degree(d) * (1 - lines[d].cuts), 1.0) / count;
  }
  double elements = 0.0;
  for (const double x : lines[0].distances)
    for (const double y : lines[1].distances)
      for (const double z : lines[2].distances)
        if (x * x + y * y + z * z < reach * reach) elements += 1.0;
  return 3.0 * elements * nodes_of_an_element;
}

void expect_no_flat_elements(const ReferenceBody& body, const std::vector<SkinPiece>& skin) {
  double most = 0.0;
  BodyElement worst{};
  for (const SkinPiece& piece : skin) {
    const nurbs::Volume& patch = body.patches[piece.patch];
    const LocalExtent extent = extent_for(patch.space);
    const int d = static_cast<int>(piece.face) / 2;
    const std::array<std::vector<int>, 2> alike = {alike_elements(patch, d == 0 ? 1 : 0, extent),
                                                   alike_elements(patch, d == 2 ? 1 : 2, extent)};
    const int counts[] = {static_cast<int>(alike[0].size()), static_cast<int>(alike[1].size())};
    for (int j = 0; j < counts[1]; ++j)
      for (int i = 0; i < counts[0]; ++i) {
        if (alike[0][i] != i || alike[1][j] != j) continue;
        const BodyElement behind = element_behind(body, piece, i + counts[0] * j);
        const double unknowns = unknowns_about(patch, behind.element, extent);
        if (unknowns > most) most = unknowns, worst = behind;
      }
  }
  if (most <= LocalProblem::kMostUnknowns) return;
  const nurbs::Volume& patch = body.patches[worst.patch];
  const Vector3 place =
      nurbs::interpolate(patch.space, patch.control_points, patch.space.element_centre(worst.element));
  throw std::invalid_argument(
      fmt::format("local compliances are known of elements that are not too flat, given those about ({:.6g}, "
                  "{:.6g}, {:.6g}), of which one has about {:.0f} unknowns, expected at most {}",
                  place[0], place[1], place[2], most, LocalProblem::kMostUnknowns));
}

}  // namespace structure

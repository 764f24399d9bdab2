// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/near_elements.h"

#include <algorithm>
#include <limits>
#include <set>

#include "structure/weld.h"

namespace structure {

NearElements::NearElements(const ReferenceBody& body) : body_(body), is_free_(6 * body.patches.size()) {
  std::vector<nurbs::Space<3>> spaces;
  for (const nurbs::Volume& patch : body.patches) spaces.push_back(patch.space);
  for (const SkinPiece& piece : free_faces(spaces, body.nodes))
    is_free_[6 * piece.patch + static_cast<int>(piece.face)] = true;
}

std::array<std::array<int, 2>, 3> NearElements::support(int patch, int control_point) const {
  const nurbs::Space<3>& space = body_.patches[patch].space;
  std::array<std::array<int, 2>, 3> spans;
  for (int d = 0, rest = control_point; d < 3; rest /= space.control_point_count(d++)) {
    const nurbs::KnotVector& knots = space.knots(d);
    const int first = rest % space.control_point_count(d);
    spans[d] = {knots.element_at(knots.knots()[first]), 0};
    int& end = spans[d][1] = spans[d][0];
    while (end < knots.element_count() && knots.span_of_element(end) <= first + knots.degree()) ++end;
  }
  return spans;
}

std::vector<NodeNumbering::Place> NearElements::places_of(Id node) const {
  const std::vector<Id>& welded = body_.nodes.welded();
  const auto found = std::lower_bound(welded.begin(), welded.end(), node);
  if (found == welded.end() || *found != node) return {body_.nodes.place(node)};
  return body_.nodes.places_of_welded(found - welded.begin());
}

int NearElements::elements_of(Id node) const {
  std::set<BodyElement> elements;
  int count = 0;
  const std::vector<NodeNumbering::Place> places = places_of(node);
  for (const auto& [patch, control_point] : places) {
    const auto spans = support(patch, control_point);
    if (places.size() == 1) {
      count = 1;
      for (const auto& [begin, end] : spans) count *= end - begin;
      return count;
    }
    for (int k = spans[2][0]; k < spans[2][1]; ++k)
      for (int j = spans[1][0]; j < spans[1][1]; ++j)
        for (int i = spans[0][0]; i < spans[0][1]; ++i)
          elements.insert({patch, body_.patches[patch].space.element_index({i, j, k})});
  }
  return static_cast<int>(elements.size());
}

NearElements::Corners NearElements::corners(const BodyElement& element) const {
  const nurbs::Volume& patch = body_.patches[element.patch];
  const nurbs::Indices<3> span = patch.space.element_indices(element.element);
  Corners corners;
  nurbs::RationalBasis<3> basis;
  for (int c = 0; c < 8; ++c) {
    nurbs::Parameter<3> xi;
    for (int d = 0; d < 3; ++d) xi[d] = patch.space.knots(d).breaks()[span[d] + (c >> d & 1)];
    nurbs::evaluate_on_element(patch.space, element.element, xi, 0, basis);
    corners[c] = nurbs::interpolate(basis, patch.control_points);
  }
  return corners;
}

namespace {

constexpr double kSamePlace = 1e-6;  // of an element

double size(const std::array<Vector3, 8>& corners) { return (corners[7] - corners[0]).norm(); }

}  // namespace

double NearElements::rise(const BodyElement& element, const Vector3& point, const Vector3& normal) const {
  const Corners at = corners(element);
  double steepest = -1.0;
  for (const Vector3& corner : at) {
    const double height = normal.dot(corner - point);
    if (height > kSamePlace * size(at)) steepest = std::max(steepest, height / (corner - point).norm());
  }
  return steepest;
}

bool NearElements::has_corners(const BodyElement& element, const std::vector<Vector3>& points) const {
  const Corners at = corners(element);
  return std::all_of(points.begin(), points.end(), [&](const Vector3& point) {
    return std::any_of(at.begin(), at.end(), [&](const Vector3& corner) {
      return (corner - point).norm() <= kSamePlace * size(at);
    });
  });
}

namespace {

double distance(const std::array<Vector3, 8>& a, const std::array<Vector3, 8>& b) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vector3& x : a)
    for (const Vector3& y : b) nearest = std::min(nearest, (x - y).norm());
  return nearest;
}

double longest_edge(const std::array<Vector3, 8>& corners) {
  double longest = 0.0;
  for (int c = 0; c < 8; ++c)
    for (int d = 0; d < 3; ++d) longest = std::max(longest, (corners[c] - corners[c ^ 1 << d]).norm());
  return longest;
}

}  // namespace

// Elements of two patches, or at both ends of one that is welded to itself, which share nodes and a corner.
void NearElements::append_across_welds(const BodyElement& element, std::vector<BodyElement>& found) const {
  const nurbs::Space<3>& space = body_.patches[element.patch].space;
  std::vector<int> control_points(space.functions_per_element());
  space.element_control_points(element.element, control_points.data());
  std::set<BodyElement> candidates;
  for (const int a : control_points) {
    const std::vector<NodeNumbering::Place> places = places_of(body_.nodes.node(element.patch, a));
    if (places.size() == 1) continue;
    for (const auto& [patch, control_point] : places) {
      const auto spans = support(patch, control_point);
      for (int k = spans[2][0]; k < spans[2][1]; ++k)
        for (int j = spans[1][0]; j < spans[1][1]; ++j)
          for (int i = spans[0][0]; i < spans[0][1]; ++i)
            candidates.insert({patch, body_.patches[patch].space.element_index({i, j, k})});
    }
  }
  if (candidates.empty()) return;
  const Corners own = corners(element);
  for (const BodyElement& candidate : candidates)
    if (distance(own, corners(candidate)) <= kSamePlace * longest_edge(own)) found.push_back(candidate);
}

std::vector<BodyElement> NearElements::neighbours(const BodyElement& element) const {
  const nurbs::Space<3>& space = body_.patches[element.patch].space;
  const nurbs::Indices<3> at = space.element_indices(element.element);
  std::vector<BodyElement> found;
  nurbs::Indices<3> low, high;
  for (int d = 0; d < 3; ++d) {
    low[d] = std::max(at[d] - 1, 0);
    high[d] = std::min(at[d] + 1, space.knots(d).element_count() - 1);
  }
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j)
      for (int i = low[0]; i <= high[0]; ++i)
        found.push_back({element.patch, space.element_index({i, j, k})});
  if (!body_.nodes.welded().empty()) append_across_welds(element, found);
  return found;
}

std::vector<BodyElement> NearElements::around(const BodyElement& element, int layers, double reach) const {
  const Corners middle = corners(element);
  const double distant = layers * reach * longest_edge(middle);
  std::set<BodyElement> all{element}, too_far;
  std::vector<BodyElement> rim{element};
  for (int layer = 1; !rim.empty(); ++layer) {
    std::vector<BodyElement> next;
    for (const BodyElement& of_rim : rim)
      for (const BodyElement& neighbour : neighbours(of_rim)) {
        if (all.count(neighbour) > 0 || too_far.count(neighbour) > 0) continue;
        if (layer > layers && !(distance(middle, corners(neighbour)) < distant)) {
          too_far.insert(neighbour);
          continue;
        }
        all.insert(neighbour);
        next.push_back(neighbour);
      }
    rim = std::move(next);
  }
  return {all.begin(), all.end()};
}

}  // namespace structure

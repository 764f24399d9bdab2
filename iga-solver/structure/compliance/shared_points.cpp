// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/shared_points.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "structure/compliance/compliance_table.h"
#include "structure/compliance/free_faces.h"
#include "structure/compliance/hit_element.h"

namespace structure {

bool TablePoint::operator<(const TablePoint& other) const {
  return std::tie(piece, element, index) < std::tie(other.piece, other.element, other.index);
}

SharedPoints::SharedPoints(const ReferenceBody& body, const NearElements& near,
                           const std::vector<SkinPiece>& skin, const std::vector<FaceSurface>& surfaces)
    : body_(body), near_(near), skin_(skin), surfaces_(surfaces) {}

SharedPoints::Sides SharedPoints::sides_of(int piece, int element) const {
  const FaceSurface& surface = surfaces_[piece];
  const std::array<int, 2> counts = table_counts(surface.space());
  const std::vector<nurbs::Parameter<2>> points = table_points(surface.space(), element);
  Sides sides{piece, element, surface.at_centre(element), {}, {}, {}};
  try {
    for (int j = 0; j < counts[1]; ++j)
      for (int i = 0; i < counts[0]; ++i) {
        if (i % (counts[0] - 1) != 0 && j % (counts[1] - 1) != 0) continue;
        const int index = i + counts[0] * j;
        SkinPoint point = surface.at(element, points[index]);
        sides.index.push_back(index);
        sides.place.push_back(std::move(point.point));
        sides.normal.push_back(std::move(point.outward_normal));
      }
  } catch (const std::invalid_argument&) {
    sides.index.clear();
  }
  return sides;
}

std::vector<SharedPoints::Sides> SharedPoints::beside(int piece, int element) const {
  std::vector<Sides> found;
  for (const BodyElement& neighbour : near_.neighbours(element_behind(body_, skin_[piece], element)))
    for (std::size_t q = 0; q < skin_.size(); ++q) {
      if (skin_[q].patch != neighbour.patch) continue;
      const int of_piece = element_on(body_, skin_[q], neighbour.element);
      if (of_piece >= 0) found.push_back(sides_of(static_cast<int>(q), of_piece));
    }
  return found;
}

std::vector<std::vector<TablePoint>> SharedPoints::of(int piece, int element) const {
  constexpr double kSamePlace = 1e-6;  // of the element
  const std::array<int, 2> counts = table_counts(surfaces_[piece].space());
  std::vector<std::vector<TablePoint>> shared(static_cast<std::size_t>(counts[0]) * counts[1]);
  const Sides own = sides_of(piece, element);
  for (std::size_t k = 0; k < shared.size(); ++k)
    shared[k] = {{piece, element, static_cast<int>(k), Vector3::Zero()}};
  if (own.index.empty()) return shared;
  const double size = (own.place.back() - own.place.front()).norm();
  for (std::size_t a = 0; a < own.index.size(); ++a) shared[own.index[a]].front().normal = own.normal[a];
  for (const Sides& other : beside(piece, element))
    for (std::size_t a = 0; a < own.index.size(); ++a)
      for (std::size_t b = 0; b < other.index.size(); ++b) {
        if ((own.place[a] - other.place[b]).norm() > kSamePlace * size) continue;
        const bool is_smooth = (own.normal[a] - other.normal[b]).norm() <= kSmooth;
        if (is_smooth || !(own.is_above(a, other.centre) || other.is_above(b, own.centre)))
          shared[own.index[a]].push_back({other.piece, other.element, other.index[b], other.normal[b]});
      }
  for (std::vector<TablePoint>& points : shared) {
    std::sort(points.begin(), points.end());
    const auto same = [](const TablePoint& a, const TablePoint& b) { return !(a < b) && !(b < a); };
    points.erase(std::unique(points.begin(), points.end(), same), points.end());
  }
  return shared;
}

}  // namespace structure

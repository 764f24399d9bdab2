// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/cross_compliance.h"

#include <algorithm>
#include <array>
#include <utility>

#include "structure/conditions/skin_surface.h"

namespace structure {

namespace {

/// In both directions [length].
std::array<double, 2> lengths(const SkinSurface& skin, int element) {
  const nurbs::Space<2>& space = skin.face.space;
  nurbs::RationalBasis<2> basis;
  nurbs::evaluate_on_element(space, element, space.element_centre(element), 1, basis);
  std::array<double, 2> lengths;
  for (int d = 0; d < 2; ++d) {
    Vector3 tangent = Vector3::Zero();
    for (int a = 0; a < basis.count; ++a) tangent += basis.dR[d][a] * skin.X.col(basis.control_point[a]);
    const std::vector<double>& breaks = space.knots(d).breaks();
    const int span = space.element_indices(element)[d];
    lengths[d] = tangent.norm() * (breaks[span + 1] - breaks[span]);
  }
  return lengths;
}

/// f(d, A, B) for each step along direction d between two of an element's control points.
template <class Function>
void for_each_step(const nurbs::Space<2>& space, int element, Function f) {
  std::vector<int> points(space.functions_per_element());
  space.element_control_points(element, points.data());
  const int counts[] = {space.degree(0) + 1, space.degree(1) + 1};
  for (int j = 0; j < counts[1]; ++j)
    for (int i = 0; i < counts[0]; ++i) {
      const int here = i + counts[0] * j;
      if (i + 1 < counts[0]) f(0, points[here], points[here + 1]);
      if (j + 1 < counts[1]) f(1, points[here], points[here + counts[0]]);
    }
}

}  // namespace

CrossCompliance::CrossCompliance(const ReferenceBody& body, const std::vector<SkinPiece>& skin) {
  struct Sum {
    double stiffness = 0.0;  // E' times what the element is long across the link
    int elements = 0;
  };
  std::map<std::pair<Id, Id>, Sum> sums;
  for (const SkinPiece& piece : skin) {
    const SkinSurface surface = skin_surface(body.patches[piece.patch], piece, body.nodes);
    const Material& material = *body.materials[piece.patch];
    const double nu = material.poissons_ratio(), modulus = material.youngs_modulus() / (1.0 - nu * nu);
    const std::vector<int>& nodes = surface.face.volume_control_point;
    for (int element = 0; element < surface.face.space.element_count(); ++element) {
      const std::array<double, 2> length = lengths(surface, element);
      for_each_step(surface.face.space, element, [&](int d, int A, int B) {
        Sum& sum = sums[std::minmax<Id>(nodes[A], nodes[B])];
        sum.stiffness += modulus * length[1 - d];
        ++sum.elements;
      });
    }
  }
  for (const auto& [ends, sum] : sums) {
    if (ends.first == ends.second || !(sum.stiffness > 0.0)) continue;  // at a pole
    for (const Id end : {ends.first, ends.second}) links_of_[end].push_back(static_cast<int>(links_.size()));
    links_.push_back({ends.first, ends.second, kShare * sum.elements / sum.stiffness});
  }
}

/// Those with an end among these nodes, which rise.
std::vector<CrossCompliance::NearLink> CrossCompliance::links_near(const std::vector<Id>& nodes) const {
  const auto place = [&](Id node) {
    const auto at = std::lower_bound(nodes.begin(), nodes.end(), node);
    return at == nodes.end() || *at != node ? -1 : static_cast<int>(at - nodes.begin());
  };
  std::vector<NearLink> near;
  for (std::size_t a = 0; a < nodes.size(); ++a)
    if (const auto found = links_of_.find(nodes[a]); found != links_of_.end())
      for (const int link : found->second) {
        const int ends[] = {place(links_[link].first), place(links_[link].second)};
        const bool is_its_turn = std::max(ends[0], ends[1]) == static_cast<int>(a);
        if (is_its_turn) near.push_back({ends[0], ends[1], links_[link].give});
      }
  return near;
}

std::vector<double> CrossCompliance::taken_at(const std::vector<SkinPoint>& feet) const {
  std::vector<Id> nodes = feet.front().nodes;
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const std::vector<NearLink> near = links_near(nodes);
  std::vector<double> taken;
  for (const SkinPoint& foot : feet) {
    const std::vector<double> R = foot.forces_on(nodes);
    double sum = 0.0;
    for (const NearLink& link : near) sum += link.give * link.step(R) * link.step(R);
    taken.push_back(sum);
  }
  return taken;
}

std::vector<CrossCompliance::OfSpread> CrossCompliance::taken_at(const std::vector<SpreadFoot>& feet) const {
  const std::vector<Id>& nodes = feet.front().beside.nodes;
  const std::vector<NearLink> near = links_near(nodes);
  std::vector<OfSpread> taken;
  for (const SpreadFoot& foot : feet) {
    const std::vector<double> R = foot.at.forces_on(nodes);
    OfSpread& sum = taken.emplace_back(OfSpread{0.0, 0.0, 0.0});
    for (const NearLink& link : near) {
      const double of_R = link.step(R), of_Z = link.step(foot.beside.Z);
      sum.taken += link.give * of_R * of_R;
      sum.one += link.give * of_R * of_Z;
      sum.both += link.give * of_Z * of_Z;
    }
  }
  return taken;
}

}  // namespace structure

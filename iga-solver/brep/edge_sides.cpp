// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/edge_sides.h"

#include <algorithm>
#include <cmath>

#include "brep/edge_foot.h"
#include "brep/edge_uses.h"

namespace brep {

namespace {

constexpr double kAsAbove = 1000.0;  // slacks within which Minima looks twice

std::int8_t sign_of(double x, double uncertain) {
  return static_cast<std::int8_t>(static_cast<int>(x > uncertain) - static_cast<int>(x < -uncertain));
}

}  // namespace

bool EdgeSides::is_smooth(const Vector3& conormal, const Vector3& other) const {
  return (conormal + other).norm() < 0.5 * surface_.edge_angle;
}

EdgeSides::Sides EdgeSides::sides(const Piece& piece, const Vector3& d, double reach, double margin) {
  const Edge& edge = surface_.edges[piece.edge[0]];
  if (edge.use_count != 2) return {};
  if (!edge.spline()) return of_whole(edge, d, reach, margin);
  const Parts& parts = parts_of(piece.edge[0], piece.chunk());
  if (!parts.are_known) return {};
  const double leeway = kAsAbove * surface_.slack_of_edge(piece.edge[0]);
  Sides sides{false, true, {0, 0}};
  for (const Part& part : parts.parts) {
    const Vector3 from = d - part.centre;
    const double away = reach + part.radius;
    if (from.squaredNorm() > away * away) continue;
    const double uncertain = part.radius + margin + leeway;
    if (std::abs(part.tangent.middle.dot(from)) > uncertain + part.tangent.most * reach) continue;
    sides.is_smooth = sides.is_smooth && part.is_smooth;
    for (int u = 0; u < 2; ++u) {
      const Spread& m = part.conormal[u];
      // Chords of the part are nearly square to the conormal.
      const double across = part.radius * std::min(1.0, m.most + 2.0 * part.tangent.most);
      const std::int8_t side = sign_of(m.middle.dot(from), across + margin + leeway + m.most * reach);
      sides.of_use[u] = !sides.has_feet || sides.of_use[u] == side ? side : std::int8_t{0};
    }
    sides.has_feet = true;
  }
  return sides;
}

// Where faces stand alike all along an edge, what tells the sides changes no faster than the point moves.
EdgeSides::Sides EdgeSides::of_whole(const Edge& edge, const Vector3& d, double reach, double margin) const {
  if (edge.varies || (!edge.line() && edge.R <= 2.0 * (reach + margin))) return {};
  const EdgeFoot foot(edge, d);
  const EdgeUse* const uses = &surface_.uses[edge.first_use];
  const double leeway = kAsAbove * surface_.slack_of_edge(uses->edge);
  Sides sides;
  const auto conormal = [&](int u) { return Vector3(uses[u].conormal[0], uses[u].conormal[1], 0.0); };
  sides.is_smooth = is_smooth(conormal(0), conormal(1));
  for (int u = 0; u < 2; ++u) {
    const double into = foot.q[0] * uses[u].conormal[0] + foot.q[1] * uses[u].conormal[1];
    sides.of_use[u] = sign_of(into, margin + leeway);
  }
  return sides;
}

const EdgeSides::Parts& EdgeSides::parts_of(int number, int chunk_of_edge) {
  constexpr double kKink = 1e-3;  // [rad]
  const Edge& edge = surface_.edges[number];
  const int chunk = edge.first_chunk + chunk_of_edge;
  if (parts_.empty()) parts_.resize(surface_.chunks.size());
  if (parts_[chunk]) return *parts_[chunk];
  auto parts = std::make_unique<Parts>();
  const Chunk& of = surface_.chunks[chunk];
  const Vector3 end = of.ends[1].first.normalized(), on = of.way_on.normalized();
  const bool has_kink = !of.way_on.isZero(0.0) && !((end - on).norm() < kKink);
  parts->are_known = !has_kink && of.ends[0].first.norm() > 0.0 && of.ends[1].first.norm() > 0.0;
  if (parts->are_known) add_parts(edge, of.curve, 0, *parts);
  parts_[chunk] = std::move(parts);
  return *parts_[chunk];
}

void EdgeSides::add_parts(const Edge& edge, const BezierCurve<3>& curve, int depth, Parts& parts) const {
  constexpr double kStraight = 0.02;
  constexpr int kMostHalvings = 6;
  const Part part = part_of(edge, curve);
  const double most = std::max({part.tangent.most, part.conormal[0].most, part.conormal[1].most});
  if (most > kStraight && depth < kMostHalvings) {
    const auto [before, behind] = curve.parts(0.5);
    add_parts(edge, before, depth + 1, parts);
    return add_parts(edge, behind, depth + 1, parts);
  }
  parts.are_known = parts.are_known && std::isfinite(most);
  parts.parts.push_back(part);
}

// Those given are some of a part, so as much again (as in patch_faces.cpp).
EdgeSides::Spread EdgeSides::spread(const std::vector<Vector3>& directions) {
  constexpr double kAsMuchAgain = 2.0;
  Spread spread{Vector3::Zero(), 0.0};
  for (const Vector3& direction : directions) spread.middle += direction;
  spread.middle.normalize();
  for (const Vector3& direction : directions)
    spread.most = std::max(spread.most, kAsMuchAgain * (direction - spread.middle).norm());
  return spread;
}

EdgeSides::Part EdgeSides::part_of(const Edge& edge, const BezierCurve<3>& curve) const {
  constexpr int kPlaces = 4;
  const double begin = surface_.chunks[edge.first_chunk].curve.begin,
               end = surface_.chunks[edge.first_chunk + edge.chunk_count - 1].curve.end;
  Part part{curve.at(0.5), 0.0, {}, {}, true};
  for (int k = 0; k <= curve.degree(); ++k)
    part.radius = std::max(part.radius, (curve.point(k) - part.centre).norm());
  std::vector<Vector3> tangents, conormals[2];
  for (int k = 0; k <= kPlaces; ++k) {
    const double s = static_cast<double>(k) / kPlaces, t = curve.begin + s * (curve.end - curve.begin);
    const auto on = curve.derivatives(s);
    const EdgePoint at{on.point, on.first.normalized(), (t - begin) / (end - begin)};
    tangents.push_back(at.tangent);
    for (int u = 0; u < 2; ++u)
      conormals[u].push_back(side_at(surface_, edge.first_use + u, at).conormal.normalized());
    part.is_smooth = part.is_smooth && is_smooth(conormals[0].back(), conormals[1].back());
  }
  part.tangent = spread(tangents);
  for (int u = 0; u < 2; ++u) part.conormal[u] = spread(conormals[u]);
  return part;
}

}  // namespace brep

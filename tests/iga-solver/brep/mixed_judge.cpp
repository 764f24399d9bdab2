// SPDX-License-Identifier: GPL-2.0-or-later
#include "mixed_judge.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace brep::trials {
namespace {

constexpr double kSame = 3e-7;  // points, lengths

}  // namespace

MixedJudge::MixedJudge(const std::vector<Face>& faces, double edge_angle)
    : faces_(faces), grids_(faces.begin(), faces.end()), edge_angle_(edge_angle), sheets_(2 * faces.size()) {
  std::iota(sheets_.begin(), sheets_.end(), 0);
  for (std::size_t f = 0; f < faces_.size(); ++f) join_sides(static_cast<int>(f));
}

// Sides of faces that meet over convex and smooth wedges along the borders of this face.
void MixedJudge::join_sides(int f) {
  const Face& face = faces_[f];
  for (int i = 0; i < 2; ++i)
    for (const double end : {face.low[i], face.high[i]}) {
      if (grids_[f].turns(i)) continue;
      Parameter<2> xi;
      xi[i] = end;
      xi[1 - i] = face.low[1 - i] + 0.4 * (face.high[1 - i] - face.low[1 - i]);
      const Vector3 p = point_on(face, xi[0], xi[1]);
      const Round here = round(p);
      if (here.face.empty() || here.inside >= 0) continue;
      for (const Judge::Wedge& wedge : Judge(here.wall, edge_angle_).wedges_at(p)) {
        if (wedge.angle <= nurbs::kPi - edge_angle_) continue;
        const int a = sheets_[2 * here.face[wedge.from / 2] + wedge.from % 2],
                  b = sheets_[2 * here.face[wedge.to / 2] + wedge.to % 2];
        if (a != b) std::replace(sheets_.begin(), sheets_.end(), std::max(a, b), std::min(a, b));
      }
    }
}

MixedJudge::Round MixedJudge::round(const Vector3& p) const {
  Round found;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Parameter<2> xi = nearest_parameters(faces_[f], p);
    if ((point_on(faces_[f], xi[0], xi[1]) - p).norm() < kSame) add_sector(static_cast<int>(f), p, xi, found);
  }
  return found;
}

void MixedJudge::add_sector(int f, const Vector3& p, const Parameter<2>& xi, Round& found) const {
  const Face& face = faces_[f];
  const std::pair<Vector3, Vector3> tangents = tangents_on(face, xi);
  const Vector3 t[2] = {tangents.first, tangents.second};
  Vector3 into[2] = {Vector3::Zero(), Vector3::Zero()};
  for (int i = 0; i < 2; ++i) {
    if (grids_[f].turns(i)) continue;
    if (std::abs(xi[i] - face.low[i]) < kSame) into[i] = t[i];
    if (std::abs(xi[i] - face.high[i]) < kSame) into[i] = -t[i];
  }
  const bool side[2] = {!into[0].isZero(), !into[1].isZero()};
  const bool pole = face.kind == Kind::sphere && std::abs(std::abs(xi[1]) - 0.5 * nurbs::kPi) < kSame;
  const auto add = [&](const Vector3& a, const Vector3& b, const Vector3& c) {
    const bool turned = (b - a).cross(c - a).dot(t[0].cross(t[1])) < 0.0;
    found.wall.add_triangle(a, turned ? c : b, turned ? b : c);
    found.face.push_back(f);
  };
  if (pole && !grids_[f].turns(0)) {
    const double up = xi[1] > 0.0 ? -1.0 : 1.0;
    add(p, p + up * tangents_on(face, {face.low[0], xi[1]}).second,
        p + up * tangents_on(face, {face.high[0], xi[1]}).second);
  } else if (pole || (!side[0] && !side[1])) {
    found.inside = f;
    found.xi = xi;
  } else if (side[0] && side[1]) {
    add(p, p + into[0], p + into[1]);
  } else {
    const int i = side[0] ? 0 : 1;
    add(p - t[1 - i], p + t[1 - i], p + into[i]);
  }
}

void MixedJudge::add_at(const Vector3& p, const Vector3& d, double angle, std::vector<Minimum>& found) const {
  const Vector3 w = d - p;
  const Round here = round(p);
  if (here.inside >= 0) {
    const auto [t0, t1] = tangents_on(faces_[here.inside], here.xi);
    const int side = t0.cross(t1).dot(w) >= 0.0 ? 0 : 1;
    if (grids_[here.inside].is_lowest_around(d, here.xi))
      found.push_back({sheet(here.inside, side), p, w.norm(), {}});
    return;
  }
  std::vector<int> all(here.face.size());
  std::iota(all.begin(), all.end(), 0);
  constexpr double kNear = 0.01;  // of triangles of size 1
  const Judge planes(here.wall, edge_angle_);
  for (const auto& sides : planes.minima_at(p, all, p + kNear * w.normalized(), kNear * angle))
    found.push_back({sheet(here.face[sides.front() / 2], sides.front() % 2), p, w.norm(), {}});
}

std::vector<Minimum> MixedJudge::minima(const Vector3& d, double reach, double tolerance,
                                        const std::vector<Vector3>& also) const {
  std::vector<Vector3> places = also;
  for (const Grid& grid : grids_)
    for (const Grid::Lowest& lowest : grid.minima(d, reach)) places.push_back(lowest.point);
  std::vector<Minimum> found;
  for (const Vector3& p : also)
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const Parameter<2> xi = nearest_parameters(faces_[f], p);
      if ((point_on(faces_[f], xi[0], xi[1]) - p).norm() < kSame)
        places.push_back(grids_[f].settle(d, xi).point);
    }
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto here = places.begin() + static_cast<std::ptrdiff_t>(k);
    const bool repeated =
        std::any_of(places.begin(), here, [&](const Vector3& x) { return (x - *here).norm() < kSame; });
    // Of feet on borders of faces curvature can decide, which planes lack.
    const double angle = k < also.size() ? 1e-3 : tolerance > 0.0 ? 1e-5 : -1e-5;
    if (!repeated && (*here - d).norm() < reach) add_at(*here, d, angle, found);
  }
  return found;
}

}  // namespace brep::trials

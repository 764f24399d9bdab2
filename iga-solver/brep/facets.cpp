// SPDX-License-Identifier: GPL-2.0-or-later
// Each face in bands between two values of xi1, in which its borders are straight, and these in trapezoids.
#include "brep/facets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "brep/face_shape.h"
#include "brep/point_hash.h"

namespace brep {
namespace {

using Segment = TrimDomain::Segment;
constexpr int kMostSteps = 1024;
constexpr double kNoBand = 1e-12;  // of the range of xi1: no band

class FaceFacets {
 public:
  FaceFacets(const Surface& surface, int face, double chord, PointHash& points, Facets& out)
      : surface_(surface),
        face_(face),
        chord_(chord),
        low_(surface.domains[face].low()),
        high_(surface.domains[face].high()),
        points_(points),
        out_(out) {}

  void add() {
    segments_ = surface_.domains[face_].segments(
        [&](const Parameter<2>& a, const Parameter<2>& b) { return is_straight(a, b); });
    for (int i = 0; i < 2; ++i) steps_[i] = steps_along(i);
    std::vector<double> levels;
    for (int k = 0; k <= steps_[1]; ++k) levels.push_back(low_[1] + k * (high_[1] - low_[1]) / steps_[1]);
    for (const Segment& segment : segments_)
      levels.insert(levels.end(), {segment.first[1], segment.second[1]});
    std::sort(levels.begin(), levels.end());
    for (size_t k = 0; k + 1 < levels.size(); ++k)
      if (levels[k + 1] - levels[k] > kNoBand * (high_[1] - low_[1])) add_band(levels[k], levels[k + 1]);
  }

 private:
  Vector3 at(const Parameter<2>& xi) const { return point_on(surface_, face_, xi); }

  // Points of the line between two are within the chord: at uneven parts of its way, as a middle alone may be
  // where a wave crosses or a helix comes round.
  bool is_straight(const Parameter<2>& a, const Parameter<2>& b) const {
    constexpr double kUneven = 0.37;
    const Vector3 from = at(a), way = at(b) - from;
    const int count = points_between(a, b);
    for (int k = 0; k <= count; ++k) {
      const double t = k == count ? 0.5 : (k + kUneven) / count;
      const Parameter<2> between{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
      if ((at(between) - from - t * way).norm() > chord_) return false;
    }
    return true;
  }

  // As many as a patch has of its degree in the elements between them, beside the middle.
  int points_between(const Parameter<2>& a, const Parameter<2>& b) const {
    int count = 4;
    for (int i = 0; i < 2 && surface_.faces[face_].kind == Kind::nurbs; ++i) {
      const std::vector<double>& breaks = knots(i).breaks();
      const auto place = [&](double xi) { return std::upper_bound(breaks.begin(), breaks.end(), xi); };
      if (a[i] != b[i])
        count += knots(i).degree() * static_cast<int>(1 + std::abs(place(b[i]) - place(a[i])));
    }
    return count;
  }

  const nurbs::KnotVector& knots(int i) const {
    return surface_.patches->patch(surface_.faces[face_].patch).space.knots(i);
  }

  // How many steps keep lines along xi_i within the chord: doubled until those do that are looked at.
  int steps_along(int i) const {
    const int other = 1 - i;
    Parameter<2> a = low_, b = low_;
    b[other] = high_[other];
    const int lines = points_between(a, b);
    for (int steps = 1; steps < kMostSteps; steps *= 2) {
      bool fine = true;
      for (int k = 0; k < steps && fine; ++k)
        for (int line = 0; line <= lines && fine; ++line) {
          a[other] = b[other] = low_[other] + line * (high_[other] - low_[other]) / lines;
          a[i] = low_[i] + k * (high_[i] - low_[i]) / steps;
          b[i] = low_[i] + (k + 1) * (high_[i] - low_[i]) / steps;
          fine = is_straight(a, b);
        }
      if (fine) return steps;
    }
    return kMostSteps;
  }

  void add_band(double begin, double end) {
    struct Crossing {
      double at_begin, at_end;
    };
    std::vector<Crossing> crossings;
    for (const auto& [a, b] : segments_) {
      const double tolerance = 0.5 * kNoBand * (high_[1] - low_[1]);
      if (std::min(a[1], b[1]) > begin + tolerance || std::max(a[1], b[1]) < end - tolerance || a[1] == b[1])
        continue;
      const auto crossed_at = [&, &a = a, &b = b](double v) {
        return a[0] + std::clamp((v - a[1]) / (b[1] - a[1]), 0.0, 1.0) * (b[0] - a[0]);
      };
      crossings.push_back({crossed_at(begin), crossed_at(end)});
    }
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
      return a.at_begin + a.at_end < b.at_begin + b.at_end;
    });
    for (size_t k = 0; k + 1 < crossings.size(); k += 2)
      add_trapezoid({crossings[k].at_begin, crossings[k + 1].at_begin}, begin,
                    {crossings[k].at_end, crossings[k + 1].at_end}, end);
  }

  void add_trapezoid(const std::array<double, 2>& u, double v, const std::array<double, 2>& u_end,
                     double v_end) {
    const double widest = std::max(u[1] - u[0], u_end[1] - u_end[0]);
    const int steps =
        std::max(1, static_cast<int>(std::ceil(steps_[0] * widest / (high_[0] - low_[0]) - 1e-9)));
    const auto corner = [&](const std::array<double, 2>& range, double level, int k) {
      return points_.number(at({range[0] + k * (range[1] - range[0]) / steps, level}));
    };
    for (int k = 0; k < steps; ++k) {
      const int a = corner(u, v, k), b = corner(u, v, k + 1), c = corner(u_end, v_end, k + 1),
                d = corner(u_end, v_end, k);
      add_triangle(a, b, c);
      add_triangle(a, c, d);
    }
  }

  void add_triangle(int a, int b, int c) {
    if (a == b || b == c || c == a) return;
    if (surface_.faces[face_].outward < 0) std::swap(b, c);
    out_.mesh.triangles.push_back({a, b, c});
    out_.face.push_back(face_);
  }

  const Surface& surface_;
  int face_;
  double chord_;
  Parameter<2> low_, high_;
  PointHash& points_;
  Facets& out_;
  std::vector<Segment> segments_;
  int steps_[2];
};

}  // namespace

Facets facets_of(const Surface& surface, double chord) {
  if (!(chord > 0.0)) throw std::invalid_argument(fmt::format("chord {}, expected more than 0", chord));
  Facets facets;
  PointHash points(1e-3 * std::min(chord, 1e-3 * surface.size));
  for (int f = 0; f < static_cast<int>(surface.faces.size()); ++f)
    FaceFacets(surface, f, chord, points, facets).add();
  facets.mesh.vertices.resize(3, static_cast<Eigen::Index>(points.points().size()));
  for (size_t k = 0; k < points.points().size(); ++k)
    facets.mesh.vertices.col(static_cast<Eigen::Index>(k)) = points.points()[k];
  return facets;
}

nurbs::TriangleMesh triangles_of(const Surface& surface, double chord) {
  return surface.trimmed() ? facets_of(surface, chord).mesh : triangles_of(surface);
}

}  // namespace brep

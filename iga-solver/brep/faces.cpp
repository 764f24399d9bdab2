// SPDX-License-Identifier: GPL-2.0-or-later
// From faces with rectangles of parameters to a wall.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

#include "brep/assembly.h"
#include "brep/bounds.h"
#include "brep/builder.h"
#include "brep/point_hash.h"
#include "brep/sides.h"

namespace brep {
namespace {

constexpr double kSameBorder = 1e-9;  // of the size

const char* name(Kind kind) {
  constexpr const char* names[] = {"plane", "cylinder", "cone", "sphere", "torus", "nurbs"};
  return names[static_cast<int>(kind)];
}

// What is wrong with a face, or an empty text.
std::string fault(const Face& face) {
  const double turn = nurbs::kTwoPi * (1.0 + 1e-9);
  for (int i = 0; i < 2; ++i) {
    const bool angle = face.kind == Kind::torus || (face.kind != Kind::plane && i == 0);
    const double range = face.high[i] - face.low[i];
    if (!(range > 0.0) || !std::isfinite(range))
      return fmt::format("its range {} to {} must rise", face.low[i], face.high[i]);
    if (angle && range > turn) return fmt::format("its range of {} rad is more than a whole turn", range);
  }
  if (face.kind != Kind::plane && face.kind != Kind::cone && !(face.R > 0.0))
    return fmt::format("radius {}, expected more than 0", face.R);
  if (face.kind == Kind::cone && !(face.r > 0.0 && face.r < 0.25 * nurbs::kTwoPi && face.low[1] >= 0.0))
    return fmt::format("half an angle of {} rad from length {} on, expected one in (0, pi/2) and 0 or more",
                       face.r, face.low[1]);
  if (face.kind == Kind::torus && !(face.r > 0.0 && face.r < face.R))
    return fmt::format("radius {} of its tube, expected one in (0, {})", face.r, face.R);
  if (face.kind == Kind::sphere &&
      !(face.low[1] >= -0.251 * nurbs::kTwoPi && face.high[1] <= 0.251 * nurbs::kTwoPi))
    return fmt::format("latitudes {} to {}, expected some from -pi/2 to pi/2", face.low[1], face.high[1]);
  return {};
}

class FromFaces {
 public:
  explicit FromFaces(const std::vector<Face>& faces) {
    if (faces.empty()) throw std::invalid_argument("faces: there are none");
    surface_.faces = faces;
    for (size_t f = 0; f < faces.size(); ++f)
      if (const std::string wrong = fault(faces[f]); !wrong.empty())
        throw std::invalid_argument(fmt::format("face {} ({}): {}", f, name(faces[f].kind), wrong));
    measure();
  }

  Surface surface(double edge_angle) {
    surface_.edge_angle = edge_angle;
    PointHash points(kSameBorder * surface_.size);
    for (size_t f = 0; f < surface_.faces.size(); ++f) {
      surface_.faces[f].first_piece = static_cast<int>(surface_.pieces.size());
      if (surface_.faces[f].kind == Kind::plane)
        add_plane(static_cast<int>(f), points);
      else
        add_curved(static_cast<int>(f), points);
      surface_.faces[f].piece_count =
          static_cast<int>(surface_.pieces.size()) - surface_.faces[f].first_piece;
    }
    for (const Vector3& x : points.points()) surface_.vertices.push_back({x, 0, 0});
    assemble(surface_, match());
    return std::move(surface_);
  }

 private:
  void measure() {
    surface_.low.setConstant(1e300);
    surface_.high.setConstant(-1e300);
    for (const Face& face : surface_.faces) {
      const Bounds box = bounds_of(face);
      surface_.low = surface_.low.cwiseMin(box.low);
      surface_.high = surface_.high.cwiseMax(box.high);
    }
    surface_.size = (surface_.high - surface_.low).norm();
    surface_.slack = 2.0 * kSameBorder * surface_.size;
  }

  // Two triangles.
  void add_plane(int f, PointHash& points) {
    const Face& face = surface_.faces[f];
    int at[4];
    for (int i = 0; i < 4; ++i) at[i] = points.number(face.point(corner_parameters(face, i)));
    const int first = static_cast<int>(surface_.pieces.size());
    surface_.pieces.push_back({f, {at[0], at[1], at[2]}, {-1, -1, -1}});
    surface_.pieces.push_back({f, {at[0], at[2], at[3]}, {-1, -1, -1}});
    matched_.mate.resize(4 * surface_.pieces.size(), -1);
    matched_.mate[side_number(first, 2)] = side_number(first + 1, 0);
    matched_.mate[side_number(first + 1, 0)] = side_number(first, 2);
  }

  void add_curved(int f, PointHash& points) {
    const Face& face = surface_.faces[f];
    Borders borders;
    const bool whole = face.whole_turn(0) || face.whole_turn(1);
    if (!whole)
      for (int i = 0; i < 4; ++i) borders.vertex[i] = points.number(face.point(corner_parameters(face, i)));
    else if (face.kind == Kind::cone && !is_border(face, 0))
      borders.vertex[0] = points.number(face.frame.origin);
    surface_.pieces.push_back(
        {f, {-1, -1, -1}, {static_cast<int>(surface_.borders.size()), -1, -1}, Piece::Kind::rectangle});
    surface_.borders.push_back(borders);
    matched_.mate.resize(4 * surface_.pieces.size(), -1);
  }

  // Sides with the same ends, the same middle and of one kind; closed ones with the same centre, radius and
  // axis.
  MatchedSides match() {
    PointHash middles(kSameBorder * surface_.size), radii(kSameBorder * surface_.size), axes(1e-7);
    std::map<std::tuple<int, int, int, int, int>, std::vector<int>> found;
    const int pieces = static_cast<int>(surface_.pieces.size());
    for (int p = 0; p < pieces; ++p)
      for (int i = 0; i < 4; ++i) {
        const Piece& piece = surface_.pieces[p];
        const Face& face = surface_.faces[piece.face];
        const int side = side_number(p, i);
        if (piece.triangle() ? i == 3 || matched_.mate[side] >= 0 : !is_border(face, i)) continue;
        const Edge curve = curve_of(surface_, side);
        const int radius = radii.number({curve.R, 0.0, 0.0});
        if (!piece.triangle() && face.whole_turn(i % 2)) {
          const Vector3 &a = curve.axis, next(a[1], a[2], a[0]);  // products, the same of a and -a
          found[{-1, axes.number(a.cwiseProduct(a)), middles.number(curve.origin), radius,
                 axes.number(a.cwiseProduct(next))}]
              .push_back(side);
          continue;
        }
        const int* at = piece.triangle() ? piece.vertex : surface_.borders[piece.borders()].vertex;
        const int a = at[i], b = at[(i + 1) % (piece.triangle() ? 3 : 4)];
        found[{std::min(a, b), std::max(a, b), middles.number(curve.point(0.5 * curve.length)), radius, 1}]
            .push_back(side);
      }
    matched_.first.assign(1, 0);
    for (const auto& [key, sides] : found) {
      matched_.sides.insert(matched_.sides.end(), sides.begin(), sides.end());
      matched_.first.push_back(static_cast<int>(matched_.sides.size()));
    }
    return matched_;
  }

  Surface surface_;
  MatchedSides matched_;
};

}  // namespace

Surface from_faces(const std::vector<Face>& faces, double edge_angle) {
  return FromFaces(faces).surface(edge_angle);
}

}  // namespace brep

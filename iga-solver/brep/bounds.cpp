// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/bounds.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace brep {
namespace {

struct Interval {
  double low, high;
};
Interval operator*(const Interval& a, const Interval& b) {
  const double corner[4] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
  return {*std::min_element(corner, corner + 4), *std::max_element(corner, corner + 4)};
}
Interval operator*(double s, const Interval& a) { return Interval{s, s} * a; }
Interval operator+(const Interval& a, const Interval& b) { return {a.low + b.low, a.high + b.high}; }
Interval operator+(double s, const Interval& a) { return {s + a.low, s + a.high}; }

// p cos(t) + q sin(t) for t in a range: a wave, so its ends and the crests between them.
Interval wave(double p, double q, double low, double high) {
  const double start = p * std::cos(low) + q * std::sin(low), end = p * std::cos(high) + q * std::sin(high);
  const double height = std::hypot(p, q), crest = std::atan2(q, p);
  Interval values{std::min(start, end), std::max(start, end)};
  const auto met = [&](double t) { return t + nurbs::kTwoPi * std::ceil((low - t) / nurbs::kTwoPi) <= high; };
  if (met(crest)) values.high = height;
  if (met(crest + 0.5 * nurbs::kTwoPi)) values.low = -height;
  return values;
}

// Of what is in a plane face's rectangle.
Bounds bounds_of_plane(const Face& face) {
  Bounds box{face.point(face.low), face.point(face.low)};
  for (const Parameter<2>& corner :
       {Parameter<2>{face.high[0], face.low[1]}, face.high, Parameter<2>{face.low[0], face.high[1]}}) {
    box.low = box.low.cwiseMin(face.point(corner));
    box.high = box.high.cwiseMax(face.point(corner));
  }
  return box;
}

}  // namespace

Bounds bounds_of(const Face& face) {
  if (face.kind == Kind::plane) return bounds_of_plane(face);
  Bounds box;
  const Interval second{face.low[1], face.high[1]};
  for (int i = 0; i < 3; ++i) {
    const Interval e = wave(face.frame.x[i], face.frame.y[i], face.low[0], face.high[0]);
    const double z = face.frame.z[i];
    Interval x{0.0, 0.0};
    if (face.kind == Kind::cylinder) x = face.R * e + z * second;
    if (face.kind == Kind::cone) x = second * (std::cos(face.r) * z + std::sin(face.r) * e);
    if (face.kind == Kind::sphere || face.kind == Kind::torus) {
      const bool torus = face.kind == Kind::torus;
      const double tube = torus ? face.r : face.R, ring = torus ? face.R : 0.0;
      const Interval cos = wave(1.0, 0.0, second.low, second.high),
                     sin = wave(0.0, 1.0, second.low, second.high);
      x = (ring + tube * cos) * e + tube * z * sin;
    }
    box.low[i] = face.frame.origin[i] + x.low;
    box.high[i] = face.frame.origin[i] + x.high;
  }
  return box;
}

namespace {

// Cells of the range of parameters in which there is some of the face.
void add_cells(const Face& whole, const TrimDomain& domain, std::vector<Bounds>& boxes) {
  constexpr int kCells = 12;
  const double step[2] = {(whole.high[0] - whole.low[0]) / kCells, (whole.high[1] - whole.low[1]) / kCells};
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      Face cell = whole;
      cell.low = {whole.low[0] + i * step[0], whole.low[1] + j * step[1]};
      cell.high = {whole.low[0] + (i + 1) * step[0], whole.low[1] + (j + 1) * step[1]};
      if (domain.where(cell.low, cell.high) == TrimDomain::Where::outside) continue;
      boxes.push_back(bounds_of(cell));
    }
}

// Ends and middles of small arcs, and how far these bulge beyond them.
void add_arcs(const Edge& edge, std::vector<Bounds>& boxes) {
  constexpr int kArcs = 16;
  const double angle = edge.length / kArcs, bulge = edge.R * (1.0 - std::cos(0.25 * angle));
  for (int k = 0; k < kArcs; ++k) {
    const Vector3 a = edge.point(k * angle), b = edge.point((k + 0.5) * angle),
                  c = edge.point((k + 1) * angle);
    boxes.push_back({(a.cwiseMin(b).cwiseMin(c).array() - bulge).matrix(),
                     (a.cwiseMax(b).cwiseMax(c).array() + bulge).matrix()});
  }
}

void add_edge(const Surface& surface, const Piece& piece, std::vector<Bounds>& boxes) {
  const Edge& edge = surface.edges[piece.edge[0]];
  if (edge.line()) {
    const Vector3 a = edge.point(0.0), b = edge.point(edge.length);
    boxes.push_back({a.cwiseMin(b), a.cwiseMax(b)});
  } else if (!edge.spline()) {
    add_arcs(edge, boxes);
  } else {
    const BezierCurve<3>& curve = surface.chunks[edge.first_chunk + piece.chunk()].curve;
    Bounds box{curve.point(0), curve.point(0)};
    for (int k = 1; k <= curve.degree(); ++k) {
      box.low = box.low.cwiseMin(curve.point(k));
      box.high = box.high.cwiseMax(curve.point(k));
    }
    boxes.push_back(box);
  }
}

}  // namespace

void add_boxes(const Surface& surface, const Piece& piece, std::vector<Bounds>& boxes) {
  switch (piece.kind) {
    case Piece::Kind::trimmed:
      return add_cells(surface.faces[piece.face], surface.domains[piece.face], boxes);
    case Piece::Kind::edge:
      return add_edge(surface, piece, boxes);
    case Piece::Kind::element: {
      const search::Box& box = surface.patches->hull(surface.faces[piece.face].patch, piece.element()).box();
      return boxes.push_back({box.low, box.high});
    }
    case Piece::Kind::vertex: {
      const Vector3& point = surface.vertices[piece.vertex[0]].point;
      return boxes.push_back({point, point});
    }
    case Piece::Kind::rectangle:
      return boxes.push_back(bounds_of(surface.faces[piece.face]));
    case Piece::Kind::triangle: {
      const auto corner = [&](int i) -> const Vector3& { return surface.vertices[piece.vertex[i]].point; };
      return boxes.push_back({corner(0).cwiseMin(corner(1)).cwiseMin(corner(2)),
                              corner(0).cwiseMax(corner(1)).cwiseMax(corner(2))});
    }
  }
}

Circle circle_around(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3* corner[3] = {&a, &b, &c};
  for (int i = 0; i < 3; ++i) {  // on the longest side if the angle at the third point is not acute
    const Vector3 &p = *corner[i], &q = *corner[(i + 1) % 3], &opposite = *corner[(i + 2) % 3];
    if ((p - opposite).dot(q - opposite) <= 0.0) return {0.5 * (p + q), 0.5 * (p - q).norm()};
  }
  const Vector3 u = b - a, v = c - a, n = u.cross(v);
  const Vector3 to_centre =
      (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) / (2.0 * n.squaredNorm());
  return {a + to_centre, to_centre.norm()};
}

}  // namespace brep

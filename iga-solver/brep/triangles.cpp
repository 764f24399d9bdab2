// SPDX-License-Identifier: GPL-2.0-or-later
// From triangles to plane faces.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "brep/assembly.h"
#include "brep/builder.h"
#include "brep/side_matching.h"
#include "brep/sides.h"
#include "brep/t_junctions.h"

namespace brep {
namespace {

constexpr double kSameplane = 1e-6;  // of the size: coordinates in STL files are in single precision

class FromTriangles {
 public:
  FromTriangles(const NodalVectors& points, const std::vector<int>& triangles, BuildReport& report)
      : points_(points), report_(report) {
    check(triangles);
    take(triangles);
    matched_ = match(points.cols(), corner_);
    join_at_t_junctions();
    measure();
    cut_into_planes();
  }

  Surface surface(double edge_angle) const {
    Surface surface;
    surface.edge_angle = edge_angle;
    surface.low = low_, surface.high = high_, surface.size = size_;
    surface.slack = 1e-13 * std::max(size_, points_.cwiseAbs().maxCoeff());
    surface.vertices.reserve(points_.cols());
    for (Eigen::Index i = 0; i < points_.cols(); ++i) surface.vertices.push_back({points_.col(i), 0, 0});
    add_faces(surface);
    assemble(surface, matched_of_pieces());
    return surface;
  }

 private:
  using Triangle = std::array<int, 3>;

  void check(const std::vector<int>& triangles) {
    if (triangles.size() % 3 != 0)
      throw std::invalid_argument("triangles: " + std::to_string(triangles.size()) +
                                  " numbers of points, not 3 each");
    for (size_t k = 0; k < triangles.size(); ++k)
      if (triangles[k] < 0 || triangles[k] >= points_.cols())
        throw std::invalid_argument("triangle " + std::to_string(k / 3) + ": point " +
                                    std::to_string(triangles[k]) + " is not among the " +
                                    std::to_string(points_.cols()));
    if (!points_.allFinite()) throw std::invalid_argument("triangles: a coordinate is not a finite number");
    if (triangles.empty()) throw std::invalid_argument("triangles: there are none");
    low_ = points_.rowwise().minCoeff();
    high_ = points_.rowwise().maxCoeff();
    size_ = (high_ - low_).norm();
  }

  // Without those that have collapsed.
  void take(const std::vector<int>& triangles) {
    corner_.reserve(triangles.size() / 3);
    for (size_t k = 0; k < triangles.size(); k += 3) {
      const Triangle t{triangles[k], triangles[k + 1], triangles[k + 2]};
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
        ++report_.collapsed;
        continue;
      }
      corner_.push_back(t);
      number_.push_back(static_cast<int>(k / 3));
    }
    report_.duplicates = leave_out_duplicates(points_.cols(), corner_, number_);
  }

  void join_at_t_junctions() {
    const CutTriangles cut = cut_at_t_junctions(points_, corner_, matched_, kOnSide * size_);
    report_.t_junctions = cut.junctions;
    if (cut.junctions == 0) return;
    std::vector<int> number;
    number.reserve(cut.number.size());
    for (const int t : cut.number) number.push_back(number_[t]);
    corner_ = cut.corners;
    number_ = number;
    matched_ = match(points_.cols(), corner_);
  }

  Vector3 at(int triangle, int i) const { return points_.col(corner_[triangle][i % 3]); }

  void measure() {
    const int count = static_cast<int>(corner_.size());
    normal_.resize(3, count);
    area_.resize(count);
    height_.resize(count);
    for (int t = 0; t < count; ++t) {
      const Vector3 n = (at(t, 1) - at(t, 0)).cross(at(t, 2) - at(t, 0));
      double longest = 0.0;
      for (int i = 0; i < 3; ++i) longest = std::max(longest, (at(t, i + 1) - at(t, i)).norm());
      area_[t] = 0.5 * n.norm();
      height_[t] = longest > 0.0 ? 2.0 * area_[t] / longest : 0.0;
      normal_.col(t) = n.normalized();
      if (report_.worst_triangle < 0 || height_[t] < report_.least_height) {
        report_.worst_triangle = number_[t];
        report_.least_height = height_[t];
      }
    }
  }
  bool thin(int t) const { return height_[t] < kSameplane * size_; }

  // Planes grow from the largest triangle on: its plane is the surest.
  void cut_into_planes() {
    const int count = static_cast<int>(corner_.size());
    std::vector<int> order(count);
    for (int t = 0; t < count; ++t) order[t] = t;
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return area_[a] > area_[b]; });
    plane_.assign(count, -1);
    for (const int t : order)
      if (plane_[t] < 0 && !thin(t)) grow(t);
    for (int t = 0; t < count; ++t) {
      if (plane_[t] < 0)
        ++report_.collapsed;
      else if (thin(t))
        ++report_.thin;
    }
    if (seeds_.empty())
      throw std::invalid_argument("triangles: all of them are thinner than 1e-6 of the whole");
  }

  void grow(int seed) {
    const int plane = static_cast<int>(seeds_.size());
    seeds_.push_back(seed);
    plane_[seed] = plane;
    std::vector<int> queue{seed};
    while (!queue.empty()) {
      const int t = queue.back();
      queue.pop_back();
      for (int i = 0; i < 3; ++i) {
        const int mate = matched_.mate[side_number(t, i)];
        if (mate < 0) continue;
        const int other = piece_of_side(mate);
        if (plane_[other] >= 0 || !lies_beyond(seed, t, i, other, mate % 4)) continue;
        if (corner_[other][mate % 4] == corner_[t][i]) turn_over(other);
        plane_[other] = plane;
        queue.push_back(other);
      }
    }
  }

  // Whether `other` goes on in the plane of the seed beyond side i of t.
  bool lies_beyond(int seed, int t, int i, int other, int side) const {
    const Vector3 n = normal_.col(seed), origin = at(seed, 0);
    const bool is_thin = thin(other);
    for (int k = 0; k < 3; ++k)
      if (std::abs(n.dot(at(other, k) - origin)) > (is_thin ? 3.0 : 1.0) * kSameplane * size_) return false;
    const Vector3 into = n.cross(at(t, i + 1) - at(t, i));
    return is_thin || into.dot(at(other, side + 2) - at(t, i)) < 0.0;
  }

  void turn_over(int t) {
    std::swap(corner_[t][1], corner_[t][2]);  // sides 0 and 2 change places
    std::swap(matched_.mate[side_number(t, 0)], matched_.mate[side_number(t, 2)]);
    for (const int i : {0, 2})
      if (const int mate = matched_.mate[side_number(t, i)]; mate >= 0)
        matched_.mate[mate] = side_number(t, i);
    turned_.push_back(t);
    normal_.col(t) *= -1.0;
  }

  // Faces are numbered as their first triangles are.
  void add_faces(Surface& surface) const {
    surface.faces.reserve(seeds_.size());
    std::vector<int> face(seeds_.size(), -1), count;
    for (const int plane : plane_) {
      if (plane < 0) continue;
      if (face[plane] < 0) {
        face[plane] = static_cast<int>(surface.faces.size());
        Face shape;
        const int seed = seeds_[plane];
        shape.frame = frame_at(at(seed, 0), normal_.col(seed), at(seed, 1) - at(seed, 0));
        surface.faces.push_back(shape);
      }
      ++surface.faces[face[plane]].piece_count;
    }
    int sum = 0;
    for (Face& f : surface.faces) {
      f.first_piece = sum;
      sum += f.piece_count;
      f.piece_count = 0;
    }
    surface.pieces.resize(sum);
    piece_of_.assign(plane_.size(), -1);
    for (size_t t = 0; t < plane_.size(); ++t) {
      if (plane_[t] < 0) continue;
      Face& f = surface.faces[face[plane_[t]]];
      piece_of_[t] = f.first_piece + f.piece_count++;
      surface.pieces[piece_of_[t]] = {
          face[plane_[t]], {corner_[t][0], corner_[t][1], corner_[t][2]}, {-1, -1, -1}};
    }
  }

  // Sides of pieces instead of triangles; those inside a plane are no edges.
  MatchedSides matched_of_pieces() const {
    std::vector<bool> turned(plane_.size(), false);
    for (const int t : turned_) turned[t] = true;
    const auto moved = [&](int side) { return side_number(piece_of_[piece_of_side(side)], side % 4); };
    const auto now = [&](int side) {  // sides as they are since triangles were turned over
      return turned[piece_of_side(side)] && side % 4 != 1 ? side_number(piece_of_side(side), 2 - side % 4)
                                                          : side;
    };
    MatchedSides result;
    int pieces = 0;
    for (const int p : piece_of_) pieces = std::max(pieces, p + 1);
    result.mate.assign(4 * static_cast<size_t>(pieces), -1);
    result.first.push_back(0);
    for (size_t e = 0; e + 1 < matched_.first.size(); ++e) {
      const int begin = matched_.first[e], end = matched_.first[e + 1];
      const int a = now(matched_.sides[begin]), b = now(matched_.sides[end - 1]);
      const int plane = plane_[piece_of_side(a)];
      if (end - begin == 2 && plane >= 0 && plane == plane_[piece_of_side(b)] && runs_against(a, b)) {
        result.mate[moved(a)] = moved(b);
        result.mate[moved(b)] = moved(a);
        continue;
      }
      for (int k = begin; k < end; ++k) {
        const int side = now(matched_.sides[k]);
        if (plane_[piece_of_side(side)] >= 0) result.sides.push_back(moved(side));
      }
      if (result.first.back() < static_cast<int>(result.sides.size()))
        result.first.push_back(static_cast<int>(result.sides.size()));
    }
    return result;
  }
  bool runs_against(int a, int b) const {
    return corner_[piece_of_side(a)][a % 4] == corner_[piece_of_side(b)][(b % 4 + 1) % 3];
  }

  const NodalVectors& points_;
  BuildReport& report_;
  Vector3 low_, high_;
  double size_ = 0.0;
  std::vector<Triangle> corner_;
  std::vector<int> number_;  // as given
  MatchedSides matched_;     // sides of triangles; mates over all edges of two
  NodalVectors normal_;
  std::vector<double> area_, height_;
  std::vector<int> plane_, seeds_, turned_;
  mutable std::vector<int> piece_of_;
};

}  // namespace

Surface from_triangles(const NodalVectors& points, const std::vector<int>& triangles, double edge_angle,
                       BuildReport* report) {
  BuildReport unseen;
  return FromTriangles(points, triangles, report != nullptr ? *report : unseen).surface(edge_angle);
}

}  // namespace brep

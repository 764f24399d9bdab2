// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/triangles_in_plane.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "nurbs/assert.h"

namespace brep {

struct TrianglesInPlane::Box {
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
  void add(const Box& other) {
    for (int i = 0; i < 2; ++i) {
      low[i] = std::min(low[i], other.low[i]);
      high[i] = std::max(high[i], other.high[i]);
    }
  }
};

namespace {

constexpr int kMostInCells = 16;  // of each triangle, in the mean
constexpr double kUneven = 1e-5;  // of the size: triangles are in their face's plane to 1e-6 of it

}  // namespace

double TrianglesInPlane::Triangle::depth(const Parameter<2>& xi) const {
  const auto below = [&](int i) { return slope[i][0] * xi[0] + slope[i][1] * xi[1] + shift[i]; };
  return std::min(below(0), std::min(below(1), below(2)));
}

inline int TrianglesInPlane::Grid::column(int i, double x) const {
  return static_cast<int>(std::clamp((x - low[i]) * cells_per_length[i], 0.0, count[i] - 1.0));
}

TrianglesInPlane::TrianglesInPlane(const Surface& surface) {
  triangles_.reserve(surface.pieces.size());
  const double rim = kUneven * surface.size;  // contacts are outside of the last triangle by round-off
  for (const Face& face : surface.faces) {
    const Frame& frame = face.frame;
    std::vector<Box> boxes(face.piece_count);
    for (int k = 0; k < face.piece_count; ++k) {
      const Piece& piece = surface.pieces[face.first_piece + k];
      NURBS_ASSERT(piece.triangle() && face.first_piece + k == static_cast<int>(triangles_.size()), k);
      const auto corner = [&](int i) -> Vector3 {
        return surface.vertices[piece.vertex[i % 3]].point - frame.origin;
      };
      Triangle& own = triangles_.emplace_back();
      const bool has_area = (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm() > 0.0;
      for (int i = 0; i < 3; ++i) {
        const double at[2] = {corner(i).dot(frame.x), corner(i).dot(frame.y)};
        boxes[k].add({{at[0] - rim, at[1] - rim}, {at[0] + rim, at[1] + rim}});
        const Vector3 inwards = frame.z.cross(corner(i + 1) - corner(i)).normalized();
        own.slope[i][0] = inwards.dot(frame.x), own.slope[i][1] = inwards.dot(frame.y);
        own.shift[i] = has_area ? -inwards.dot(corner(i)) : -std::numeric_limits<double>::infinity();
      }
    }
    Grid grid = grid_over(boxes);
    grid.first_piece = face.first_piece;
    fill(grid, boxes);
    grids_.push_back(grid);
  }
}

// About as many cells as triangles, about square; fewer where long ones would be in too many.
TrianglesInPlane::Grid TrianglesInPlane::grid_over(const std::vector<Box>& boxes) const {
  Box whole;
  for (const Box& box : boxes) whole.add(box);
  Grid grid;
  grid.piece_count = static_cast<int>(boxes.size());
  grid.first_cell = static_cast<int>(begin_.size()) - 1;
  const double width = whole.high[0] - whole.low[0], height = whole.high[1] - whole.low[1],
               across = std::sqrt(grid.piece_count * width / height);
  const int most = std::max(1, grid.piece_count);
  grid.count[0] = across < most ? std::max(1, static_cast<int>(across)) : most;
  grid.count[1] = std::max(1, most / grid.count[0]);
  for (;; grid.count[0] = (grid.count[0] + 1) / 2, grid.count[1] = (grid.count[1] + 1) / 2) {
    for (int i = 0; i < 2; ++i) {
      grid.low[i] = whole.low[i];
      grid.cells_per_length[i] = grid.count[i] == 1 ? 0.0 : grid.count[i] / (whole.high[i] - whole.low[i]);
    }
    double in_cells = 0.0;
    for (const Box& box : boxes) {
      double cells = 1.0;
      for (int i = 0; i < 2; ++i) cells *= 1 + grid.column(i, box.high[i]) - grid.column(i, box.low[i]);
      in_cells += cells;
    }
    if (in_cells <= static_cast<double>(kMostInCells) * most || grid.count[0] * grid.count[1] == 1)
      return grid;
  }
}

void TrianglesInPlane::fill(const Grid& grid, const std::vector<Box>& boxes) {
  const auto for_each_cell = [&](const Box& box, auto visit) {
    for (int j = grid.column(1, box.low[1]); j <= grid.column(1, box.high[1]); ++j)
      for (int i = grid.column(0, box.low[0]); i <= grid.column(0, box.high[0]); ++i)
        visit(grid.first_cell + i + grid.count[0] * j);
  };
  std::vector<int>& end = begin_;  // of each cell, as long as the next has not begun
  end.resize(end.size() + grid.count[0] * grid.count[1], 0);
  for (const Box& box : boxes) for_each_cell(box, [&](int cell) { ++end[cell + 1]; });
  std::partial_sum(end.begin() + grid.first_cell, end.end(), end.begin() + grid.first_cell);
  pieces_.resize(end.back());
  std::vector<int> next(end.begin() + grid.first_cell, end.end());
  for (int k = 0; k < grid.piece_count; ++k)
    for_each_cell(boxes[k],
                  [&](int cell) { pieces_[next[cell - grid.first_cell]++] = grid.first_piece + k; });
}

int TrianglesInPlane::deepest(const int* pieces, const int* end, const Parameter<2>& xi) const {
  int found = -1;
  double most = -std::numeric_limits<double>::infinity();
  for (; pieces != end; ++pieces)
    if (const double depth = triangles_[*pieces].depth(xi); depth > most) most = depth, found = *pieces;
  return found;
}

int TrianglesInPlane::at(int face, const Parameter<2>& xi) const {
  const Grid& grid = grids_[face];
  const int cell = grid.first_cell + grid.column(0, xi[0]) + grid.count[0] * grid.column(1, xi[1]);
  const int found = deepest(pieces_.data() + begin_[cell], pieces_.data() + begin_[cell + 1], xi);
  if (found >= 0) return found;
  std::vector<int> all(grid.piece_count);
  std::iota(all.begin(), all.end(), grid.first_piece);
  return deepest(all.data(), all.data() + all.size(), xi);
}

}  // namespace brep

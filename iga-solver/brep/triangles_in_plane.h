// SPDX-License-Identifier: GPL-2.0-or-later
// Which triangle of a plane face a point of it is in: known from the cell of a grid over the face.
#pragma once

#include <vector>

#include "brep/surface.h"

namespace brep {

class TrianglesInPlane {
 public:
  /// Of plane faces, whose pieces are triangles.
  explicit TrianglesInPlane(const Surface& surface);

  /// The piece of this face that the point is deepest in: how far from the nearest line through its sides,
  /// which is less than 0 outside of it; the first of equals.  Triangles without an area have no inside.
  int at(int face, const Parameter<2>& xi) const;

 private:
  struct Triangle {
    double slope[3][2], shift[3];  // of the depth below each side, over the face's parameters
    double depth(const Parameter<2>& xi) const;
  };
  // Cells of one face, and the triangles whose boxes reach into each.
  struct Grid {
    int first_piece, piece_count;
    double low[2], cells_per_length[2];
    int count[2];
    int first_cell;
    int column(int i, double x) const;
  };
  struct Box;
  Grid grid_over(const std::vector<Box>& boxes) const;
  void fill(const Grid& grid, const std::vector<Box>& boxes);
  int deepest(const int* pieces, const int* end, const Parameter<2>& xi) const;

  std::vector<Triangle> triangles_;  // by piece
  std::vector<Grid> grids_;          // by face
  std::vector<int> begin_ = {0};     // of each cell's pieces; the end of the last
  std::vector<int> pieces_;
};

}  // namespace brep

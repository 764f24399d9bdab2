// SPDX-License-Identifier: GPL-2.0-or-later
// Flat triangles that share their corners, as STL files have them.
#pragma once

#include <string>
#include <vector>

#include "nurbs/tessellation.h"

namespace geometry_io {

/// Corners within this part of the size of all triangles (the diagonal of their box) are one point: STL files
/// are written in single precision, so a corner that several triangles share may differ in the last digits.
constexpr double kSamePoint = 1e-6;

/// The triangles of one block `solid` of an STL file, or of several of these.  One triangle at least; each
/// has three different points, and no two have the same three.
struct TriangleMesh {
  std::string name;            ///< of the block, may be empty
  nurbs::NodalVectors points;  ///< [length]; each belongs to a triangle
  std::vector<int> triangles;  ///< three points for each, in the order of the file
  std::vector<int> place;  ///< of each triangle in its file, from 1: the line of its `facet`, or its number
  bool binary = false;     ///< the file was: places are numbers
  int degenerate = 0;      ///< triangles left out: two corners were one point
  int repeated = 0;        ///< triangles left out: the same three points as an earlier one, in any order

  int count() const { return static_cast<int>(place.size()); }
};

/// Of triangles that did not come from a file: their places are their numbers.
TriangleMesh mesh_of(const nurbs::TriangleMesh& triangles);

/// Triangles as a file has them, one after the other.
struct TriangleSoup {
  struct Block {
    std::string name;
    int first;  ///< triangle
  };
  std::vector<Block> blocks;    ///< in the order of their triangles
  std::vector<double> corners;  ///< 9 for each triangle: x, y, z of its corners
  std::vector<int> place;       ///< as in TriangleMesh
  bool binary = false;          ///< as in TriangleMesh
};
/// Of each block a mesh; none of blocks without triangles, or with degenerate ones alone.
std::vector<TriangleMesh> meshes_of(const TriangleSoup& soup);

/// Several meshes as one, with the points merged that they share.
struct JoinedMesh {
  TriangleMesh mesh;      ///< without a name
  std::vector<int> part;  ///< of each triangle: which of the meshes it is from
};
JoinedMesh joined(const std::vector<const TriangleMesh*>& meshes);

/// Edges that one triangle alone has and that hang together: the rim of a hole, or of a sheet.  Where corners
/// lie on sides of other triangles there is none.
struct Gap {
  int edges = 0;
  double length = 0.0;  ///< of all of them [length]
  int triangle = 0;     ///< the first that has such an edge
};
/// The longest first.
std::vector<Gap> gaps_of(const TriangleMesh& mesh);

struct OverlappingPairs {
  long count = 0;               ///< of two triangles
  int first = -1, second = -1;  ///< triangles of the first of them
};
/// Triangles that lie over each other or pierce each other by more than kSamePoint of the size.  Those that
/// touch, at sides and corners that they share or not (T-junctions), do neither.
struct Overlaps {
  OverlappingPairs in_plane;  ///< one lies in the plane of the other and covers part of it
  OverlappingPairs piercing;  ///< each goes through the other
};
/// Triangles thinner than kSamePoint of the size are passed over.
Overlaps overlaps_of(const TriangleMesh& mesh);

}  // namespace geometry_io

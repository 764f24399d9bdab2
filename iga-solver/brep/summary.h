// SPDX-License-Identifier: GPL-2.0-or-later
// What a wall consists of, in numbers for its user.
#pragma once

#include <vector>

#include "brep/surface.h"

namespace brep {

/// Faces that hang together over edges and enclose a volume.
struct Shell {
  Vector3 low, high;        ///< box around it
  double volume = 0.0;      ///< < 0: normals point inwards [length^3]
  bool inside_out = false;  ///< they should, as it is in the space that others enclose, or should not
};

struct Summary {
  int faces[6] = {0, 0, 0, 0, 0, 0};  ///< by Kind
  int pieces = 0, vertices = 0, sheets = 0;
  int smooth = 0, near_smooth = 0;  ///< edges of two faces: within 1e-3 rad of pi, within edge_angle
  int convex = 0, concave = 0;      ///< sharp ones, as seen from where the normal of the first face points
  int free = 0, many = 0;           ///< edges of one face; of three or more
  double area = 0.0;                ///< 0 of trimmed faces [length^2]
  bool closed = false;              ///< no free edges: it encloses a volume
  double volume = 0.0;              ///< if closed, with the faces turned alike, else 0 [length^3]
  double free_length = 0.0;         ///< of free edges [length]
  std::vector<Shell> shells = {};   ///< if there is a volume, of triangles
};

Summary summary_of(const Surface& surface);

/// Faces by kind, edges, extent: two lines.
std::string text_of(const Surface& surface);

}  // namespace brep

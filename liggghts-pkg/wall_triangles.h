// SPDX-License-Identifier: GPL-2.0-or-later
// The wall in triangles, as it stands now: its own, if it is made of them; cells x cells x 2 per element of
// patches; of trimmed faces as many as keep within a chord of them.
#ifndef LMP_WALL_TRIANGLES_H
#define LMP_WALL_TRIANGLES_H

#include "coupling/surface_exchange.h"
#include "nurbs/tessellation.h"

namespace liggghts_pkg {

class WallTriangles {
 public:
  /// Keeps references to both.  `cells`: per element and direction; of trimmed faces the chord is
  /// brep::kFacetChord with 2, and shrinks with their square.
  WallTriangles(const coupling::StructureSolver& structure, const coupling::SurfaceExchange& exchange,
                int cells);

  /// From now on those within `chord` of the surface [length].  Throws std::invalid_argument as
  /// nurbs::cells_within.
  void keep_within(double chord);
  /// How many there are about, and of what: "a wall of 35 elements".
  double count() const;
  std::string of_what() const;
  int cells() const { return cells_; }
  /// In space, in the place that the exchange has brought.
  nurbs::TriangleMesh in_space() const;

 private:
  nurbs::TriangleMesh in_body() const;

  const coupling::StructureSolver& structure_;
  const coupling::SurfaceExchange& exchange_;
  int cells_;
  double chord_ = 0.0;  // of trimmed faces
};

}  // namespace liggghts_pkg

#endif

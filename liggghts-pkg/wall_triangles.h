// SPDX-License-Identifier: GPL-2.0-or-later
// The wall in triangles, as it stands now: its own, if it is made of them, else cells x cells x 2 per
// element.
#ifndef LMP_WALL_TRIANGLES_H
#define LMP_WALL_TRIANGLES_H

#include "coupling/surface_exchange.h"
#include "nurbs/tessellation.h"

namespace liggghts_pkg {

class WallTriangles {
 public:
  /// Keeps references to both.
  WallTriangles(const coupling::StructureSolver& structure, const coupling::SurfaceExchange& exchange)
      : structure_(structure), exchange_(exchange) {}

  /// How many there are, and of what: "a wall of 35 elements".
  double count(int cells) const;
  std::string of_what() const;
  /// The cells that keep them within `chord` of the surface [length].  Throws std::invalid_argument as
  /// nurbs::cells_within.
  int cells_within(double chord) const;
  /// In space, in the place that the exchange has brought.
  nurbs::TriangleMesh in_space(int cells) const;

 private:
  nurbs::TriangleMesh in_body(int cells) const;

  const coupling::StructureSolver& structure_;
  const coupling::SurfaceExchange& exchange_;
};

}  // namespace liggghts_pkg

#endif

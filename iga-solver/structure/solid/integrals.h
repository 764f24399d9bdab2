// SPDX-License-Identifier: GPL-2.0-or-later
// The integrals of a solid that every step asks for, whatever the way to work them out: element by element
// (element_loop.h), or by sweeps (sweep/patch_sweep.h).
#pragma once

#include "nurbs/types.h"

namespace structure {

/// What quadrature points remember, [element][point][Material::state_size()]; an element's points are counted
/// as tensor products, the first direction fastest, of the most points that a span of each direction has.
struct PointMemory {
  const double* held = nullptr;
  double* next = nullptr;  ///< of a time step: where the memory at its end goes; null: held
  double dt = 0.0;         ///< of this step [time]
};

class Integrals {
 public:
  virtual ~Integrals() = default;
  /// f = internal forces [force] of the displacements u [length], both 3 x nodes.  No allocation.
  virtual void internal_force(const PointMemory& memory, const nurbs::NodalVectors& u,
                              nurbs::NodalVectors& f) const = 0;
  virtual double strain_energy(const PointMemory& memory, const nurbs::NodalVectors& u) const = 0;
  /// Memory of the tables that it keeps [bytes].
  virtual double table_bytes() const = 0;
};

}  // namespace structure

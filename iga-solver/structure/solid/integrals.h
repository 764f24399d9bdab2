// SPDX-License-Identifier: GPL-2.0-or-later
// The integrals of a solid that every step asks for, whatever the way to work them out: element by element
// (element_loop.h), or by sweeps (sweep/patch_sweep.h).
#pragma once

#include "nurbs/types.h"
#include "structure/exact_sum.h"

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
  virtual int box_count() const = 0;
  /// Adds the internal forces [force] of boxes [first, end), each as one share, to f; of the displacements u
  /// [length], both 3 x columns.  No allocation.
  virtual void add_forces(int first, int end, const PointMemory& memory, const nurbs::NodalVectors& u,
                          nurbs::NodalVectors& f) const = 0;
  /// Adds the change of the internal forces along a change w [length] of the displacements u: K(u) w, memory
  /// held.  No allocation but in the first call.
  virtual void add_force_changes(const PointMemory& memory, const nurbs::NodalVectors& u,
                                 const nurbs::NodalVectors& w, nurbs::NodalVectors& f) const = 0;
  /// Adds the stored energy of each box.
  virtual void add_energies(const PointMemory& memory, const nurbs::NodalVectors& u, ExactSum& sum) const = 0;
  /// Memory of the tables that it keeps [bytes].
  virtual double table_bytes() const = 0;

  void internal_force(const PointMemory& memory, const nurbs::NodalVectors& u, nurbs::NodalVectors& f) const {
    f.setZero();
    add_forces(0, box_count(), memory, u, f);
  }
  double strain_energy(const PointMemory& memory, const nurbs::NodalVectors& u) const {
    ExactSum sum;
    add_energies(memory, u, sum);
    return sum.value();
  }
};

}  // namespace structure

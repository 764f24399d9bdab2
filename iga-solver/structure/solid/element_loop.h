// SPDX-License-Identifier: GPL-2.0-or-later
// The plain way: one element after the other, dR/dX at every point from a table.  What all other ways are
// held against, and the only one for degrees that are not swept.
#pragma once

#include <vector>

#include "structure/solid/box_grid.h"
#include "structure/solid/element_tables.h"
#include "structure/solid/integrals.h"

namespace structure {

class ElementLoop final : public Integrals {
 public:
  /// X: undeformed positions [length], 3 x columns.  Keeps a reference to the material.  Throws
  /// std::invalid_argument if the patch is left-handed or folded.
  ElementLoop(const nurbs::Space<3>& space, const nurbs::NodalVectors& X, const std::vector<PlacedBox>& boxes,
              const Material& material, Quadrature quadrature);

  int box_count() const override { return static_cast<int>(boxes_.size()); }
  void add_forces(int first, int end, const PointMemory& memory, const nurbs::NodalVectors& u,
                  nurbs::NodalVectors& f) const override;
  void add_force_changes(const PointMemory& memory, const nurbs::NodalVectors& u,
                         const nurbs::NodalVectors& w, nurbs::NodalVectors& f) const override;
  void add_energies(const PointMemory& memory, const nurbs::NodalVectors& u, ExactSum& sum) const override;
  double table_bytes() const override;

 private:
  struct Element {
    std::vector<int> read, write;  // columns, and nodes of the box
    ElementTables tables;
  };
  struct Box {
    std::size_t first, end;  // elements
    std::vector<int> write;  // columns
  };
  /// Of what element_force(element, f_element) gives.
  template <class ElementForce>
  void add_shares(int first, int end, nurbs::NodalVectors& f, ElementForce element_force) const;
  ElementMemory memory_of(std::size_t element, const PointMemory& memory) const;

  const Material& material_;
  std::size_t remembered_;  // numbers per element
  ForceKernel force_kernel_;
  std::vector<Element> elements_;
  std::vector<Box> boxes_;
  mutable nurbs::NodalVectors share_;  // forces of one box
};

/// Columns of an element's control points, the first direction fastest, from those of its box.
std::vector<int> element_columns(const nurbs::Space<3>& space, const SpanBox& box,
                                 const std::vector<int>& columns, const std::array<int, 3>& span);

}  // namespace structure

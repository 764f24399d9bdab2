// SPDX-License-Identifier: GPL-2.0-or-later
// Local compliances of a body's skin: one table per element, made when it is first asked for.  The elements
// that take part are others on the two sides of a border; there tables have the mean, so that a foot that
// crosses it changes no force.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "structure/compliance/compliance_table.h"
#include "structure/compliance/hit_element.h"
#include "structure/compliance/local_problem.h"
#include "structure/compliance/shared_points.h"

namespace structure {

class ComplianceTables {
 public:
  /// `skin`: pieces of the surface that is touched.  Throws std::invalid_argument, naming what is not for it
  /// and what is, unless the laws of their patches are isotropic, elastic and without memory, and their
  /// degrees 2 or 3.
  ComplianceTables(ReferenceBody body, std::vector<SkinPiece> skin);
  ComplianceTables(const ComplianceTables&) = delete;
  ComplianceTables& operator=(const ComplianceTables&) = delete;

  /// Of an element of a piece's surface.  Throws std::invalid_argument, with the place, where none can be
  /// made.
  const ComplianceTable& of(int piece, int element) {
    const ComplianceTable* const known = known_[piece][element];
    return known ? *known : find(piece, element);
  }
  /// What the elements about one have at any point of it, without a table or a mean: the tensor in space.
  Matrix3 direct(int piece, int element, const nurbs::Parameter<2>& xi) const;

  int solved() const { return solved_; }  ///< for how many elements; those that see the same share one

 private:
  using Tensors = std::vector<Matrix3>;  // in space, at table_points()
  struct Solved {
    Tensors tensors;
    std::string problem;  // why there are none
  };
  /// What a table is made of: tensors and which of them, point by point.
  using Origin = std::vector<std::pair<const Tensors*, int>>;

  const ComplianceTable& find(int piece, int element);
  int first_alike(int piece, int element) const;
  const Solved& solved(int piece, int element);
  Tensors solve(int piece, int element) const;
  LocalPatch patch_of(const HitElement& hit) const;
  std::unique_ptr<ComplianceTable> table(int piece, int element, const Tensors& values) const;

  ReferenceBody body_;
  NearElements near_;
  mutable GradientProducts gradients_;
  std::vector<SkinPiece> skin_;
  std::vector<FaceSurface> surfaces_;
  SharedPoints shared_;
  std::vector<std::array<std::vector<int>, 2>> alike_;  // per piece and direction (alike_elements.h)
  std::vector<std::vector<Solved>> solved_of_;          // [piece][first of the elements that are alike]
  int solved_ = 0;
  std::map<Origin, std::unique_ptr<ComplianceTable>> tables_;
  std::vector<std::vector<const ComplianceTable*>> known_;  // [piece][element]; null: not asked for before
};

}  // namespace structure

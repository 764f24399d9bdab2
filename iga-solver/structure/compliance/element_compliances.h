// SPDX-License-Identifier: GPL-2.0-or-later
// Local compliances of the elements of a body's skin, each by itself, as the body stands: what tables are
// made of.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "structure/compliance/compliance_table.h"
#include "structure/compliance/cross_compliance.h"
#include "structure/compliance/hit_element.h"
#include "structure/compliance/local_problem.h"
#include "structure/compliance/shared_points.h"
#include "structure/compliance/skin_net.h"
#include "structure/compliance/spread_table.h"

namespace structure {

class ElementCompliances {
 public:
  using Tensors = std::vector<Matrix3>;  ///< in space, at table_points() [length/force]

  /// `skin`: pieces of the surface that is touched; keeps a reference.  Throws std::invalid_argument, naming
  /// what is not for it and what is, unless the laws of their patches are isotropic, elastic and without
  /// memory, and their degrees 2 or 3.
  /// `net`: of the undeformed body; null: this is it.
  ElementCompliances(ReferenceBody body, const std::vector<SkinPiece>& skin,
                     std::shared_ptr<const SkinNet> net = nullptr);
  ElementCompliances(const ElementCompliances&) = delete;
  ElementCompliances& operator=(const ElementCompliances&) = delete;

  const ReferenceBody& body() const { return body_; }
  const NearElements& near() const { return near_; }
  const SharedPoints& shared() const { return shared_; }
  const std::shared_ptr<const SkinNet>& net() const { return net_; }
  const FaceSurface& surface(int piece) const { return surfaces_[piece]; }
  HitElement hit(int piece, int element) const {
    return {body_, near_, skin_[piece], surfaces_[piece], element};
  }

  struct Solved {
    Tensors tensors;
    std::string problem;  ///< why there are none
  };
  /// Of an element of a piece's surface; those that see the same share one.
  const Solved& solved(int piece, int element);
  /// Of forces that are spread: `one` at all points, then `both`.
  const Solved& solved_spread(int piece, int element);
  int solved_count() const { return solved_; }
  /// Of those that see the same.
  int first_alike(int piece, int element) const;
  /// In the surface's parameters, as the first of those that are alike.
  std::array<double, 2> lengths(int piece, int element) const;
  /// Others are asked from here on: keeps what it has solved, and nothing that would help to solve more.
  void rest() { gradients_.forget(); }
  /// At any point of it.
  Matrix3 direct(int piece, int element, const nurbs::Parameter<2>& xi) const;
  LocalProblem::OfSpread spread_direct(int piece, int element, const nurbs::Parameter<2>& xi) const;
  /// Of tensors at its points, as the first of the elements that are alike: to the last bit, whoever asks.
  /// `taken`: what is taken off along the normal there, or nothing [length/force].
  std::unique_ptr<ComplianceTable> table(int piece, int element, const Tensors& tensors,
                                         const std::vector<double>& taken = {}) const;
  /// Of tensors that are spread, less what links take of the element with this number there; null: nothing.
  std::unique_ptr<SpreadTable> spread_table(int piece, int element, const Tensors& tensors,
                                            const CrossCompliance* links) const;

 private:
  LocalPatch patch_around(const HitElement& hit, const std::vector<Id>& pressed) const;
  Tensors at(const HitElement& hit, const std::vector<nurbs::Parameter<2>>& points) const;
  SpreadFoot spread_foot(const HitElement& hit, const nurbs::Parameter<2>& xi, const SkinPoint& at) const;
  std::vector<LocalProblem::OfSpread> spread_at(const HitElement& hit,
                                                const std::vector<nurbs::Parameter<2>>& points) const;

  ReferenceBody body_;
  NearElements near_;
  mutable GradientProducts gradients_;
  const std::vector<SkinPiece>& skin_;
  std::vector<FaceSurface> surfaces_;
  SharedPoints shared_;
  std::shared_ptr<const SkinNet> net_;
  std::vector<std::array<std::vector<int>, 2>> alike_;  // per piece and direction (alike_elements.h)
  std::vector<std::vector<Solved>> solved_of_;          // [piece][first of the elements that are alike]
  std::vector<std::vector<Solved>> spread_of_;          // likewise
  int solved_ = 0;
};

}  // namespace structure

// SPDX-License-Identifier: GPL-2.0-or-later
// Local compliances of a body's skin: one table per element, made when it is first asked for.  On an element
// c is a polynomial of degree 2 p in each direction, but for what the half-space's data add, which vary
// little; so (2 p + 1)^2 values hold it.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "structure/compliance/hit_element.h"
#include "structure/compliance/local_problem.h"
#include "structure/compliance/table_kernel.h"

namespace structure {

/// Of one element of the skin.
class ComplianceTable {
 public:
  /// Components of the tensor in the frame (t_1, t_2, n): t_1 along the surface's first direction, n out of
  /// the body, t_2 = n x t_1.
  enum Component { normal, first, second, first_second, first_normal, second_normal, kComponents };
  static constexpr int kTogether = first_second + 1;  ///< those that a contact with friction asks for

  /// c [length/force], and its changes with the parameters [length/force/parameter].
  struct Value {
    double c;
    std::array<double, 2> change;
  };

  /// From values at the product of lobatto_points(count) in both directions, the first fastest:
  /// [component][point].
  ComplianceTable(const std::array<int, 2>& counts, const std::vector<std::vector<double>>& values);

  /// On the element [low, high] of the parameters.
  Value at(Component component, const nurbs::Parameter<2>& low, const nurbs::Parameter<2>& high,
           const nurbs::Parameter<2>& xi) const;
  /// The first kTogether components, to the last bit as one by one.
  std::array<Value, kTogether> together(const nurbs::Parameter<2>& low, const nurbs::Parameter<2>& high,
                                        const nurbs::Parameter<2>& xi) const;
  /// Largest value at its points [length/force].
  double largest_normal() const { return largest_normal_; }

 private:
  static constexpr int kMost = 7 * 7;  // values of a component: of degree 3

  // In one piece, as it comes from memory.
  TableKernel kernel_;
  std::array<int, 2> counts_;
  double largest_normal_;
  std::array<double, kTogether * kMost> together_;  // [of t][of s][component] in s, t from -1 to 1
  std::array<double, kComponents * kMost> powers_;  // [component][of t][of s], the same
};

/// Chebyshev's points with both ends of [-1, 1], rising.
std::vector<double> lobatto_points(int count);

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
  /// The same at any point of it without a table: the tensor in space.
  Matrix3 direct(int piece, int element, const nurbs::Parameter<2>& xi) const;

  int made() const { return made_; }  ///< how many tables

 private:
  const ComplianceTable& find(int piece, int element);
  LocalPatch patch_of(const HitElement& hit) const;
  std::unique_ptr<ComplianceTable> solve(int piece, const HitElement& hit) const;

  ReferenceBody body_;
  NearElements near_;
  mutable GradientProducts gradients_;
  std::vector<SkinPiece> skin_;
  std::vector<FaceSurface> surfaces_;
  std::vector<std::array<std::vector<int>, 2>> alike_;  // per piece and direction (alike_elements.h)
  std::vector<std::vector<std::unique_ptr<ComplianceTable>>> tables_;  // [piece][element]; null: not made yet
  std::vector<std::vector<const ComplianceTable*>> known_;  // the same, of each element that was asked for
  int made_ = 0;
};

}  // namespace structure

// SPDX-License-Identifier: GPL-2.0-or-later
// Whether elements do what their law is not for: turn, where it is one of small strain (a rotation by theta
// strains it by about theta^2/2), or fold, where it goes on as if nothing had happened (F enters Saint
// Venant-Kirchhoff's law as F^T F alone).  Elements are looked at in turn, each
// once in kTurns steps at least, and none while displacements are far too small.  What is seen first is the
// affine motion that fits an element's nodes best, x = c + F X; only where that, or how far they are from it,
// leaves room for a fold are the quadrature points asked.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "structure/body.h"
#include "structure/halo.h"

namespace structure {

class ElementWatch {
 public:
  static constexpr int kTurns = 1024;
  static constexpr double kLargestTurn = 3.0;  ///< of a law of small strain [degrees]

  /// Looks at the next elements; `largest_u`: a bound of the components of u [length].
  void look(const Body& body, const NodalVectors& u, double largest_u);
  void look_at_all(const Body& body, const NodalVectors& u);

  /// A part's element, and its rotation [degrees] or smallest det F [-].
  struct Seen {
    int element;
    double value;
    bool is_folded;
  };
  /// What has been seen first of each kind.
  const std::optional<Seen>& turned() const { return turned_; }
  const std::optional<Seen>& folded() const { return folded_; }

 private:
  struct Fit;
  Fit fit(const Body& body, const NodalVectors& u, int element);
  void look_at(const Body& body, const NodalVectors& u, int element);

  int next_ = 0;      // element
  double due_ = 0.0;  // elements
  // Spacing of nodes in an element [length]; 0 until all are known.
  double smallest_ = 0.0, smallest_so_far_ = std::numeric_limits<double>::infinity();
  std::optional<Seen> turned_, folded_;
  std::vector<double> values_;
};

/// What has been seen, in one line; nothing if nothing has.  Collective: of all parts, in the same words on
/// each.
std::string describe_turned(const Body& body, const Halo& halo, const ElementWatch& watch, double time);
std::string describe_folded(const Body& body, const Halo& halo, const ElementWatch& watch, double time);

}  // namespace structure

// SPDX-License-Identifier: GPL-2.0-or-later
// Which elements of the skin go on as one another without an edge, in a patch, over C0 knots and over welds,
// and what strips (border_strips.h) take up where their tables do not.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "structure/compliance/border_strips.h"
#include "structure/compliance/element_compliances.h"

namespace structure {

class SmoothBorders {
 public:
  /// Keeps a reference.
  explicit SmoothBorders(const ElementCompliances& undeformed) : undeformed_(undeformed) {}

  /// An element, and those that go on from it: [of t][of s], itself in the middle; no element: < 0.
  struct Around {
    std::array<std::array<SkinElement, 3>, 3> elements;
    bool is_regular = true;  ///< all over knots of one patch
  };
  Around around(int piece, int element) const;

  /// Tables of one kind: how many polynomials they have, by powers as [polynomial][of t][of s], null where
  /// there is no table; `turn(values, c, s)` turns values in another frame, whose t_1 is c t_1 + s t_2, into
  /// the element's own.
  struct Polynomials {
    int count;
    std::function<const double*(int piece, int element)> powers;
    void (*turn)(double* values, double c, double s);
  };
  BorderKinks kinks(int piece, int element, const Polynomials& of) const;

 private:
  struct Side {
    int piece, element, direction, end;
  };
  /// Another element's side that is in the place of an element's.
  struct Beyond {
    Side side;
    bool is_reversed;  // runs the other way
    bool is_regular;   // over a knot of the patch
  };
  struct Meeting;
  using Borders = decltype(BorderKinks::border);
  using Seams = std::array<std::array<std::optional<Beyond>, 2>, 2>;  // [direction][end]
  std::optional<Beyond> beyond(const Side& side) const;
  const Seams& seams(int piece, int element) const;
  std::optional<Beyond> beyond_seam(const Side& side,
                                    const std::vector<std::vector<TablePoint>>& points) const;
  Meeting meeting(const Side& own, const Beyond& beyond, double along) const;
  Side past(const Side& border, int corner_end) const;
  std::vector<double> kink(const Side& own, const Polynomials& of) const;
  std::vector<double> corner_kink(int piece, int element, const std::array<int, 2>& ends,
                                  const Borders& borders, const Polynomials& of) const;

  const ElementCompliances& undeformed_;
  mutable std::map<std::pair<int, int>, Seams> seams_;  // as far as asked for
};

}  // namespace structure

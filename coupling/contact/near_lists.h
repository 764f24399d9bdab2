// SPDX-License-Identifier: GPL-2.0-or-later
// Which pieces of a wall are near each particle, remembered from list to list: lists are built anew for the
// fastest particle, while most have hardly moved over the wall.
#pragma once

#include <vector>

#include "brep/near_cells.h"

namespace contact {

class NearLists {
 public:
  /// Keeps references.
  NearLists(const brep::FootSearch& search, brep::NearCells& cells) : search_(search), cells_(cells) {}

  /// Adds pieces, all within `reach` of d among them, their numbers rising; none if none is within.
  /// `particle`: any number, best of who was near d when it asked last.
  void near(int particle, const nurbs::Vector3& d, double reach, std::vector<int>& pieces);

 private:
  // Around a place; whoever comes there may use it.
  struct Known {
    nurbs::Vector3 centre = nurbs::Vector3::Zero();
    double radius = 0.0;      // all pieces within are these
    double least = 0.0;       // none is within this distance [length]
    double most = 0.0;        // one is within this distance, or it is infinite
    std::vector<int> pieces;  // their numbers rise
  };
  void look(const nurbs::Vector3& d, double reach, Known& known);
  bool any_within(const nurbs::Vector3& d, double reach, const Known& known) const;

  const brep::FootSearch& search_;
  brep::NearCells& cells_;
  std::vector<Known> known_;  // by particle
};

}  // namespace contact

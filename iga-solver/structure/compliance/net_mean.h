// SPDX-License-Identifier: GPL-2.0-or-later
// A mean over the control points of a body's skin and those beside them, along the net: what spreads a force
// over a contact's disc, and the displacement that is met by it, where elements are so small beside the disc
// that a point force makes a dent of its own (README.md).  Across welds as along the net, seams left out; not
// over edges.
#pragma once

#include <map>
#include <vector>

#include "structure/compliance/free_faces.h"
#include "structure/compliance/reference_body.h"
#include "structure/compliance/smooth_seams.h"

namespace structure {

class NetMean {
 public:
  /// What the mean adds to a force at `from` less the force itself: shares that sum to zero, also with the
  /// undeformed places of their nodes where the net is straight.
  struct Share {
    Id from, to;
    double share;
  };
  /// A share of each of these is on each neighbour of a regular net, four times it leaves the node: the
  /// second moment is 2 kShare h^2 in both directions, that of a flat punch's pressure, a^2/3, for
  /// a = 1.1 h.
  static constexpr double kShare = 0.2;

  /// Of the pieces of the skin that forces act on.
  NetMean(const ReferenceBody& body, const std::vector<SkinPiece>& skin, const SmoothSeams& seams);

  /// Of all nodes, rising.
  const std::vector<Share>& shares() const { return shares_; }
  /// What is beside a unit force at a foot where it is spread, less that force: by nodes, rising.
  struct Beside {
    std::vector<Id> nodes;
    std::vector<double> Z;  ///< [-]
  };
  Beside beside(const SkinPoint& foot) const;

 private:
  std::vector<Share> shares_;
  std::map<Id, int> first_;  // of shares from a node
};

/// A foot whose force is spread, and what is beside it there.
struct SpreadFoot {
  SkinPoint at;
  NetMean::Beside beside;
  Matrix3 frame;  ///< columns t_1, t_2, n (FaceSurface)
  double room;    ///< how far the skin goes on about it; infinite: as far as can be [length]
};

}  // namespace structure

// SPDX-License-Identifier: GPL-2.0-or-later
// What the surface's mesh gives way under a contact beyond what the body does: a contact law that holds the
// give of a half-space counts it twice (iga-solver/structure/compliance has the derivation); and what it
// gives way too much under a contact by the forces of others beside it.
#pragma once

#include <array>
#include <vector>

#include "coupling/contact_surface.h"
#include "nurbs/multi_patch.h"

namespace coupling {

class LocalCompliance {
 public:
  virtual ~LocalCompliance() = default;

  struct Component {
    double c;                      ///< [length/force]
    std::array<double, 2> change;  ///< with the parameters of the foot's patch [length/force/parameter]
  };
  /// In the frame of t_1 along the surface's first direction, n out of the body and t_2 = n x t_1.  What a
  /// force along n does along the surface is left out, 0.1 to 0.5 % of the others.
  struct Value {
    Component normal;                ///< along the normal, by a force along it
    std::array<Component, 3> along;  ///< along the surface, by forces along it: 11, 22, 12; 0: not asked for
    double taken;                    ///< of the normal's, by links(); not in `normal` [length/force]
  };
  /// Between two nodes that are control points of the surface, by ids: what is taken off the mesh's
  /// displacement under contact forces f, give (f_first - f_second) at the first, the opposite at the other
  /// (structure/compliance/cross_compliance.h).
  struct Link {
    NodeId first, second;
    double give;  ///< [length/force]
  };
  /// Each pair once, rising, the same on every rank.
  virtual std::vector<Link> links() const { return {}; }
  struct Share {
    NodeId from, to;
    double share;
  };
  /// What spreads a force R over the net about its foot: to R comes w Z, Z being of each node's force these
  /// shares, which sum to zero (structure/compliance/net_mean.h).  Rising, the same on every rank; none where
  /// forces are not spread.
  virtual std::vector<Share> shares() const { return {}; }
  /// Where nodes on smooth seams and beside them are met, and where forces on them go: shares of nodes, which
  /// sum to 1 (structure/compliance/smooth_seams.h); likewise.
  virtual std::vector<Share> seams() const { return {}; }
  /// Nodes of such seams where the mesh kinks and is met so; likewise.
  virtual std::vector<NodeId> kinks() const { return {}; }
  /// What comes to Value for a force that is spread: c + 2 w one + w^2 both, also of what links take.
  struct Spread {
    Component moment;     ///< second one of Z, the mean of both directions [length^2]
    Component height;     ///< how far Z is above the foot where the body is undeformed [length]
    Component one, both;  ///< along the normal [length/force]
    std::array<Component, 3> along_one, along_both;  ///< likewise
    Component taken;                                 ///< as Value has it, with its changes
    double taken_one, taken_both;
  };
  /// As find(); asked for few contacts.
  virtual void find_spread(const nurbs::SurfacePoint& /*foot*/, const nurbs::Indices<2>& /*element*/,
                           Spread& /*spread*/) {}
  /// `element`: of the patch, that the foot is on (KnotVector::element_at).  On one that was not asked for
  /// before this takes some time.  Throws std::invalid_argument, with the place, where it is not known.
  virtual void find(const nurbs::SurfacePoint& foot, const nurbs::Indices<2>& element, bool with_shear,
                    Value& value) = 0;

  /// The same will be asked for soon.
  virtual void foresee(const nurbs::SurfacePoint& /*foot*/, const nurbs::Indices<2>& /*element*/) const {}

  /// Whether that changes with the strain of the body.
  virtual bool follows_strain() const { return false; }
  /// Takes the body as it is strained now, but for elements that contacts are on, whose forces would jump:
  /// `feet`, of all ranks.  Collective.
  virtual void follow_strain(const std::vector<nurbs::SurfacePoint>& /*feet*/) {}
};

}  // namespace coupling

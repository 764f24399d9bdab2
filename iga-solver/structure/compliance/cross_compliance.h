// SPDX-License-Identifier: GPL-2.0-or-later
// What a mesh gives way at one foot under a force at another, beyond what the body does.  A mesh cannot
// follow waves shorter than two of its elements, so about a force its displacement rings: at an element's
// length it is too deep by up to a quarter of c (compliance_tables.h), nearer than a third of it too flat.
// Taken off is, of nodal forces f of contacts,
//
//   S f,   f . S f = sum over links (A, B) of g |f_A - f_B|^2,   g = kShare / (E' h),
//
// links being the steps from a control point of the surface to the next along the mesh, h the length of the
// elements across the step.  It is symmetric, so it has a potential, and is nothing for forces that do not
// vary from node to node, whose displacement the mesh has right.  One number serves both degrees and every
// Poisson ratio: on blocks of equal elements, all places at eighths of an element, what is wrong at an
// element's length and beyond falls from 27 % of c to 13 % (cubic from 21 to 12 %), at three quarters of it
// from 37 to 17 %; nearer than a third, where it is without limit, it grows by a third of c.
#pragma once

#include <map>
#include <vector>

#include "structure/compliance/free_faces.h"
#include "structure/compliance/net_mean.h"
#include "structure/compliance/reference_body.h"

namespace structure {

class CrossCompliance {
 public:
  static constexpr double kShare = 0.45;
  /// Between two nodes of the body.
  struct Link {
    Id first, second;
    double give;  ///< [length/force]
  };
  /// Of the pieces of the skin that forces act on.
  CrossCompliance(const ReferenceBody& body, const std::vector<SkinPiece>& skin);

  /// Each once, rising.
  const std::vector<Link>& links() const { return links_; }
  /// What is taken off at each of these feet, all on one element, for a unit force there [length/force].
  std::vector<double> taken_at(const std::vector<SkinPoint>& feet) const;
  /// Of forces R there and Z beside them, all with the same nodes: of R, of R and Z, of Z.
  struct OfSpread {
    double taken, one, both;
  };
  std::vector<OfSpread> taken_at(const std::vector<SpreadFoot>& feet) const;

 private:
  /// With places among some nodes, or -1.
  struct NearLink {
    int first, second;
    double give;
    /// By what forces on these nodes differ between its ends.
    double step(const std::vector<double>& forces) const {
      return (first < 0 ? 0.0 : forces[first]) - (second < 0 ? 0.0 : forces[second]);
    }
  };
  std::vector<NearLink> links_near(const std::vector<Id>& nodes) const;

  std::vector<Link> links_;
  std::map<Id, std::vector<int>> links_of_;  // of each node
};

}  // namespace structure

// SPDX-License-Identifier: GPL-2.0-or-later
// What contacts do to a wall of triangles, as fields on it.  A contact belongs to the triangle that its foot
// is in, so that the sum of area times pressure is the total force; on an edge, to that on one of its sides.
#pragma once

#include <memory>
#include <vector>

#include "brep/piece_tree.h"
#include "coupling/contact_fields.h"

namespace coupling {

/// Places and cells are triangles.
class FaceFields final : public ContactFields {
 public:
  /// Every rank builds the same.  `surface`: plane faces alone.
  FaceFields(MPI_Comm comm, std::shared_ptr<const brep::Surface> surface);

  void add(const SurfaceContact& contact) override;
  State state(const NodalVectors& control_points, const RigidFrame& frame,
              const Selection& selection) override;

 private:
  int piece_at(const nurbs::SurfacePoint& foot);

  std::shared_ptr<const brep::Surface> surface_;
  brep::PieceTree tree_;
  Eigen::RowVectorXd area_;
  std::vector<int> near_;  // of one contact
};

}  // namespace coupling

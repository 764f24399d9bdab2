// SPDX-License-Identifier: GPL-2.0-or-later
// What contacts do to a wall of faces, as fields on its triangles, or on triangles near it if its faces are
// trimmed.  A contact belongs to the triangle that its foot is in, or nearest to, so that the sum of area
// times pressure is the total force; on an edge, to that on one of its sides.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "brep/piece_tree.h"
#include "brep/triangles_in_plane.h"
#include "coupling/contact_fields.h"

namespace coupling {

/// Places and cells are triangles.
class FaceFields final : public ContactFields {
 public:
  /// Every rank builds the same.  `surface`: plane faces alone, or trimmed ones.
  FaceFields(MPI_Comm comm, const std::shared_ptr<const brep::Surface>& surface);

  void add(const SurfaceContact& contact) override;
  State state(const NodalVectors& control_points, const RigidFrame& frame,
              const Selection& selection) override;

 private:
  FaceFields(MPI_Comm comm, std::shared_ptr<const brep::Surface> surface,
             std::shared_ptr<const brep::Surface> triangles);
  int piece_at(const nurbs::SurfacePoint& foot);
  int nearest_piece(const Vector3& point);

  std::shared_ptr<const brep::Surface> wall_, surface_;  // surface_: of triangles
  std::optional<brep::PieceTree> tree_;                  // of a trimmed wall's triangles
  std::optional<brep::TrianglesInPlane> in_plane_;       // of a wall of triangles
  Eigen::RowVectorXd area_;
  std::vector<int> near_;  // of one contact
};

}  // namespace coupling

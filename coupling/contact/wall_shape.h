// SPDX-License-Identifier: GPL-2.0-or-later
// The shape of a wall, whatever it is made of: patches, or faces in closed form.  All in the wall's frame.
// Another kind of wall is another class here, with a tracker of its feet.
#pragma once

#include <memory>
#include <vector>

#include "brep/faced_patches.h"
#include "brep/foot_search.h"
#include "brep/near_cells.h"
#include "coupling/contact/feet_tracker.h"
#include "coupling/contact/local_search.h"
#include "coupling/contact/near_lists.h"
#include "nurbs/curvature.h"
#include "search/multi_patch_tree.h"

namespace contact {

class WallShape {
 public:
  virtual ~WallShape() = default;
  /// Control points have moved near the elements that are followed, or which borders are welded.
  virtual void changed() = 0;
  /// A list of candidates is to be built; `moved`: the shape is not that of the last one.
  virtual void begin_list(bool moved) = 0;
  /// The box of all elements, and those that may be within `reach` of a point (added, numbers rising), after
  /// begin_list.
  virtual search::Box bounds() const = 0;
  virtual void near(const nurbs::Vector3& point, double reach, std::vector<int>& elements) const = 0;
  /// The same of a particle: what was found where it was may serve again.
  virtual void near_particle(int /*particle*/, const nurbs::Vector3& point, double reach,
                             std::vector<int>& elements) const {
    near(point, reach, elements);
  }
  /// Points that tell an element of a rigid wall from others: one that has them too, in any order, is the
  /// same piece of the surface.  None where nobody knows.
  virtual void points_of(int element, std::vector<nurbs::Vector3>& points) const = 0;
  /// Both must outlive the tracker.
  virtual std::unique_ptr<FeetTracker> track(const CandidateList& candidates, SearchMethod method,
                                             SearchCounts& counts) const = 0;

  /// Of length 1, at a foot wherever it is: on an edge, that of the patch or face that the foot names.
  virtual nurbs::Vector3 normal_at(const search::Foot& foot) const = 0;
  /// The same with curvatures; of a pole, those of a point beside it.
  virtual nurbs::SurfaceShape shape_near(const search::Foot& foot) const = 0;
  /// +1 or -1 where the normal points out of the body or into it; 0: two-sided.
  virtual int outward_sign(int patch) const = 0;
};

class PatchShape final : public WallShape {
 public:
  /// Keeps references; control points are 3 x n.  `edge_angle`: edges that turn by no more are smooth [rad].
  PatchShape(const nurbs::MultiPatch& surface, const nurbs::NodalVectors& control_points,
             const std::vector<int>& outward_sign, double edge_angle)
      : surface_(surface),
        control_points_(control_points),
        outward_sign_(outward_sign),
        edge_angle_(edge_angle),
        projector_(surface, control_points) {}
  void changed() override;
  void begin_list(bool moved) override;
  search::Box bounds() const override { return tree_.bounds(); }
  void near(const nurbs::Vector3& point, double reach, std::vector<int>& elements) const override {
    tree_.query(point, reach, elements);
  }
  void points_of(int element, std::vector<nurbs::Vector3>& points) const override;
  std::unique_ptr<FeetTracker> track(const CandidateList& candidates, SearchMethod method,
                                     SearchCounts& counts) const override;
  nurbs::Vector3 normal_at(const search::Foot& foot) const override;
  nurbs::SurfaceShape shape_near(const search::Foot& foot) const override;
  int outward_sign(int patch) const override { return outward_sign_[patch]; }
  const search::SurfaceProjector& patch(int p) const { return projector_.patch(p); }

 private:
  const nurbs::MultiPatch& surface_;
  const nurbs::NodalVectors& control_points_;
  const std::vector<int>& outward_sign_;
  double edge_angle_;
  search::MultiPatchProjector projector_;
  search::MultiPatchTree tree_;
};

/// Rigid, whose feet are searched on faces, edges and vertices.
class ShapeOnFaces : public WallShape {
 public:
  void changed() final {}
  void begin_list(bool /*moved*/) final {}
  search::Box bounds() const final { return {search_.surface().low, search_.surface().high}; }
  void near(const nurbs::Vector3& point, double reach, std::vector<int>& elements) const final {
    cells_.near(point, reach, elements);
  }
  void near_particle(int particle, const nurbs::Vector3& point, double reach,
                     std::vector<int>& elements) const final {
    lists_.near(particle, point, reach, elements);
  }
  void points_of(int piece, std::vector<nurbs::Vector3>& points) const final;

 protected:
  /// Keeps a reference.
  explicit ShapeOnFaces(const brep::Surface& surface)
      : search_(surface), cells_(search_), lists_(search_, cells_) {}

  brep::FootSearch search_;

 private:
  mutable brep::NearCells cells_;  // what has been asked before
  mutable NearLists lists_;        // the same, particle by particle
};

/// Of nothing else.
class FaceShape final : public ShapeOnFaces {
 public:
  explicit FaceShape(const brep::Surface& surface) : ShapeOnFaces(surface) {}
  std::unique_ptr<FeetTracker> track(const CandidateList& candidates, SearchMethod method,
                                     SearchCounts& counts) const override;
  nurbs::Vector3 normal_at(const search::Foot& foot) const override;
  nurbs::SurfaceShape shape_near(const search::Foot& foot) const override;
  int outward_sign(int face) const override { return search_.surface().faces[face].outward; }
};

/// Of patches, which are these faces.
class FacedPatchShape final : public ShapeOnFaces {
 public:
  /// Keeps references.
  FacedPatchShape(const brep::FacedPatches& faced, const nurbs::MultiPatch& surface,
                  const nurbs::NodalVectors& control_points, const std::vector<int>& outward_sign)
      : ShapeOnFaces(faced.surface),
        charts_(faced.charts),
        parts_(faced.parts),
        surface_(surface),
        control_points_(control_points),
        outward_sign_(outward_sign) {}
  std::unique_ptr<FeetTracker> track(const CandidateList& candidates, SearchMethod method,
                                     SearchCounts& counts) const override;
  /// In closed form if there is one, but on edges and where the centre is on the surface, maybe on an edge as
  /// well.
  nurbs::Vector3 normal_at(const search::Foot& foot) const override;
  nurbs::SurfaceShape shape_near(const search::Foot& foot) const override;
  int outward_sign(int patch) const override { return outward_sign_[patch]; }

 private:
  bool is_on_closed_form(const search::Foot& foot) const {
    return !charts_.empty() && foot.status == search::FootStatus::interior &&
           foot.distance > search_.same_point();
  }

  const std::vector<brep::Chart>& charts_;
  const brep::PatchParts& parts_;
  const nurbs::MultiPatch& surface_;
  const nurbs::NodalVectors& control_points_;
  const std::vector<int>& outward_sign_;
};

}  // namespace contact

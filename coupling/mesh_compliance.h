// SPDX-License-Identifier: GPL-2.0-or-later
// Local compliances of a solid of ours, as contact asks for them.  Every rank knows all of the body, as it is
// undeformed and in some states of strain, so it works out those that its particles need, and all find the
// same.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "coupling/local_compliance.h"
#include "structure/compliance/compliance_tables.h"

namespace coupling {

class MeshCompliance final : public LocalCompliance {
 public:
  /// `skin`: the pieces that are the surface's patches.  Throws as structure::ComplianceTables does.
  MeshCompliance(structure::ReferenceBody body, const std::vector<structure::SkinPiece>& skin);

  void find(const nurbs::SurfacePoint& foot, const nurbs::Indices<2>& element, bool with_shear,
            Value& value) override;
  void foresee(const nurbs::SurfacePoint& foot, const nurbs::Indices<2>& element) const override;
  void find_spread(const nurbs::SurfacePoint& foot, const nurbs::Indices<2>& element,
                   Spread& spread) override;
  std::vector<Link> links() const override;
  std::vector<Share> shares() const override;
  std::vector<Share> seams() const override;
  std::vector<NodeId> kinks() const override { return tables_.net().seams.kinks(); }
  bool follows_strain() const override { return places_ && tables_.follows_strain(); }
  void follow_strain(const std::vector<nurbs::SurfacePoint>& feet) override;
  /// Where all of the body's nodes are, 3 x node count, asked for on all ranks at the same time.
  void set_places(std::function<nurbs::NodalVectors()> places) { places_ = std::move(places); }
  const structure::ComplianceTables& tables() const { return tables_; }
  structure::ComplianceTables& tables() { return tables_; }

 private:
  template <class Ask>
  auto known(Ask ask) -> decltype(ask());

  std::vector<nurbs::Space<2>> spaces_;  // of the patches
  structure::ComplianceTables tables_;
  std::function<nurbs::NodalVectors()> places_;
};

}  // namespace coupling

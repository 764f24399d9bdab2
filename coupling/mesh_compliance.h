// SPDX-License-Identifier: GPL-2.0-or-later
// Local compliances of a solid of ours, as contact asks for them.  They are those of the body as it is
// undeformed, all of it, so every rank works out those that its particles need, and all find the same.
#pragma once

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
  const structure::ComplianceTables& tables() const { return tables_; }

 private:
  std::vector<nurbs::Space<2>> spaces_;  // of the patches
  structure::ComplianceTables tables_;
};

}  // namespace coupling

// SPDX-License-Identifier: GPL-2.0-or-later
// Tables of local compliances as tests ask for them: at a point of a body's skin.
#pragma once

#include "nurbs/boundary.h"
#include "structure/compliance/compliance_tables.h"

namespace top {

using structure::ComplianceTable;
using structure::ComplianceTables;

/// At a point of an element of the body's `p`th piece.
inline ComplianceTable::Value value(ComplianceTables& tables, const nurbs::Space<2>& space, int p,
                                    int element, const nurbs::Parameter<2>& xi,
                                    ComplianceTable::Component component) {
  const nurbs::Indices<2> span = space.element_indices(element);
  nurbs::Parameter<2> low, high;
  for (int d = 0; d < 2; ++d) {
    low[d] = space.knots(d).breaks()[span[d]];
    high[d] = space.knots(d).breaks()[span[d] + 1];
  }
  return tables.of(p, element).at(component, low, high, xi);
}

/// The top of a body of one patch.
struct Top {
  structure::ReferenceBody body;
  nurbs::Space<2> space = nurbs::boundary_surface(body.patches[0].space, nurbs::Face::zeta_plus).space;
  int element(const nurbs::Parameter<2>& xi) const { return space.element_at(xi); }
  double table(ComplianceTables& tables, const nurbs::Parameter<2>& xi,
               ComplianceTable::Component component = ComplianceTable::normal) const {
    return value(tables, xi, component).c;
  }
  ComplianceTable::Value value(ComplianceTables& tables, const nurbs::Parameter<2>& xi,
                               ComplianceTable::Component component = ComplianceTable::normal) const {
    return top::value(tables, space, 0, element(xi), xi, component);
  }
};

}  // namespace top

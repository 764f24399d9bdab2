// SPDX-License-Identifier: GPL-2.0-or-later
// OpenCASCADE's searches on the same patch.
#pragma once

#include <Extrema_GenLocateExtPS.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_BSplineSurface.hxx>

#include "nurbs/patch.h"

namespace benchmarks {

/// The knots have to be simple.  Not copied: the local search refers to the adaptor beside it.
class OpenCascade {
 public:
  explicit OpenCascade(const nurbs::Surface& surface);
  OpenCascade(const OpenCascade&) = delete;

  /// Local search from `guess`; the foot, or NaN where it fails.
  nurbs::Vector3 warm(const nurbs::Vector3& d, const nurbs::Parameter<2>& guess);
  /// Global search by the tree of samples, which is kept from call to call.
  nurbs::Vector3 cold(const nurbs::Vector3& d);

 private:
  Handle(Geom_BSplineSurface) surface_;
  GeomAdaptor_Surface adaptor_;
  Extrema_GenLocateExtPS local_;
  GeomAPI_ProjectPointOnSurf global_;
};

}  // namespace benchmarks

// SPDX-License-Identifier: GPL-2.0-or-later
// Curves of OpenCASCADE, in space or in the parameters of a face, as B-splines.
#pragma once

#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <TopoDS_Edge.hxx>
#include <string>
#include <vector>

#include "geometry_io/any_spline.h"

namespace geometry_io {

inline brep::Vector3 vector(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }
inline brep::Vector3 vector(const gp_Dir& d) { return {d.X(), d.Y(), d.Z()}; }
inline Eigen::Vector2d vector(const gp_Pnt2d& p) { return {p.X(), p.Y()}; }
inline Eigen::Vector2d vector(const gp_Dir2d& d) { return {d.X(), d.Y()}; }

/// On [from, to] in homogeneous coordinates: exact, with the curve's own parameter but for conics, whose arcs
/// have their own; within `tolerance` if it is an offset curve, which sets `fitted_anew`.  Adaptor:
/// Adaptor3d_Curve or Geom2dAdaptor_Curve.
template <class Adaptor>
AnySpline spline_of(const Adaptor& curve, double from, double to, double tolerance, bool& fitted_anew);

/// An edge that has a curve in space, without vertices and tolerance; runs forward.
brep::CadEdge edge_of(const TopoDS_Edge& edge, double tolerance, bool& fitted_anew);

}  // namespace geometry_io

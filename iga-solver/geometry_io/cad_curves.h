// SPDX-License-Identifier: GPL-2.0-or-later
// Curves of a CAD model's edges, and of its faces' borders in space: points, the nearest one, parts.
#pragma once

#include <vector>

#include "brep/bezier_curve.h"
#include "brep/cad_model.h"
#include "geometry_io/any_spline.h"

namespace geometry_io {

/// A place on a curve, and how far it is from the point that it is the nearest to [length].
struct CurvePlace {
  double t, distance;
};

/// Of an edge.  Its parameter is the length along a line, the angle along an arc, a spline's own.
class EdgeCurve {
 public:
  explicit EdgeCurve(const brep::CadEdge& edge);
  double begin() const { return begin_; }
  double end() const { return end_; }
  brep::Vector3 point(double t) const;
  brep::Vector3 tangent(double t) const;  ///< of length 1
  CurvePlace nearest(const brep::Vector3& point, double from, double to) const;

 private:
  brep::BezierCurve<3>::Derivatives at(double t) const;
  double nearest_on_circle(const brep::Vector3& point, double from, double to) const;
  double nearest_on_spline(const brep::Vector3& point, double from, double to) const;

  brep::CadEdge edge_;
  double begin_, end_;
  std::vector<brep::BezierCurve<3>> curves_;
  std::vector<double> places_;  // of samples of a spline, rising
  std::vector<brep::Vector3> samples_;
};

/// Between two parameters, without vertices.
brep::CadEdge part_of(const brep::CadEdge& edge, double from, double to);

/// A trim of a face, in space.
class BorderCurve {
 public:
  BorderCurve(const brep::CadModel& model, const brep::CadFace& face, const brep::Trim& trim);
  nurbs::Parameter<2> parameters(double t) const;  ///< of the face
  brep::Vector3 point(double t) const;
  double at_part(double part) const { return curve_.begin() + part * (curve_.end() - curve_.begin()); }
  /// Where it is beside a point; `tangent` of the edge there.
  double beside(const brep::Vector3& point, const brep::Vector3& tangent) const;
  /// Into the face, across the border, of length 1.
  brep::Vector3 conormal(double t, const brep::Vector3& tangent) const;

 private:
  const brep::CadModel& model_;
  const brep::CadFace& face_;
  bool forward_;
  AnySpline curve_;
};

/// Between two of its parameters; a coordinate that is the same all along stays so to the last bit.
brep::Spline<2> part_of(const brep::Spline<2>& curve, double from, double to);

}  // namespace geometry_io

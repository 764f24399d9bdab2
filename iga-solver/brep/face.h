// SPDX-License-Identifier: GPL-2.0-or-later
// One face of a wall in closed form: its parameters, points, normals, curvatures, and the foot of a point on
// the surface that it is cut from.  Angles in rad; e(a) = cos(a) x + sin(a) y of the frame.
//
//   kind      xi                   point(xi)                                        normal
//   plane     lengths              origin + xi0 x + xi1 y                           z
//   cylinder  angle, height        origin + R e(xi0) + xi1 z                        away from the axis
//   cone      angle, length        origin + xi1 (cos(r) z + sin(r) e(xi0)), xi1>=0  away from the axis
//   sphere    longitude, latitude  origin + R (cos(xi1) e(xi0) + sin(xi1) z)        away from the centre
//   torus     two angles           origin + (R + r cos(xi1)) e(xi0) + r sin(xi1) z  out of the tube
#pragma once

#include <cmath>
#include <cstdint>

#include "brep/names.h"

namespace brep {

/// Faces of kind nurbs are patches (cad_model.h): what this file has of points and feet is not of them.
enum class Kind : std::int8_t { plane, cylinder, cone, sphere, torus, nurbs };

/// Right-handed, axes of length 1.
struct Frame {
  Vector3 origin = Vector3::Zero();
  Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();
};
/// With this axis z, and x as near to `x` as it can be.  Throws std::invalid_argument if one of them is zero
/// or they are parallel.
Frame frame_at(const Vector3& origin, const Vector3& z, const Vector3& x);

constexpr double kOnAxis = 1e-12;  ///< of the radius: there no direction is better than another

/// Foot of a point on the surface that a face is cut from.
struct Projection {
  Parameter<2> xi;  ///< inside the face's range where a whole turn more or less leads there
  Vector3 point, normal;
  double height;   ///< signed distance along the normal [length]
  double outside;  ///< how far xi is from the range, 0 inside it and for planes, which have pieces [length]
  bool many;       ///< points round an axis or a centre are as near
};

/// The same before angles are worked out, which takes longer than all the rest; not of planes.
struct PolarFoot {
  Vector3 point, normal;
  double height;          ///< as in Projection
  double cos[2], sin[2];  ///< of xi where that is an angle
  double length;          ///< xi1 of cylinder and cone [length]
  bool many;              ///< as in Projection
};

struct Face {
  Frame frame;
  double R = 0.0;  ///< radius of cylinder, sphere and of the torus' circle [length]
  double r = 0.0;  ///< radius of the torus' tube [length]; half the angle of a cone, in (0, pi/2) [rad]
  Parameter<2> low{0.0, 0.0}, high{0.0, 0.0};  ///< range of xi
  int first_piece = 0, piece_count = 0;        ///< of Surface::pieces
  int patch = -1;                              ///< of kind nurbs: its number
  Kind kind = Kind::plane;
  int outward = 0;  ///< +1 or -1: only its side + or - is met, the other is inside a body; 0: both are

  Vector3 point(const Parameter<2>& xi) const;
  Vector3 normal(const Parameter<2>& xi) const;
  /// Parameters of a point of a plane.
  Parameter<2> in_plane(const Vector3& p) const {
    const Vector3 from = p - frame.origin;
    return {from.dot(frame.x), from.dot(frame.y)};
  }
  /// Principal, along xi0 and along xi1, positive towards the normal (as nurbs/curvature.h) [1/length].
  Parameter<2> curvatures(const Parameter<2>& xi) const;
  /// On the axis, in the centre, on the circle of a torus: in the middle of the range.
  Projection project(const Vector3& d) const;
  PolarFoot polar_foot(const Vector3& d) const;
  /// |project(d).height| alone, or less.
  double distance_of_whole(const Vector3& d) const;
  /// From the axes, centres and circles that have several feet on the surface that the face is cut from: a
  /// point that moves by less has a foot that does not jump [length].
  double distance_of_focus(const Vector3& d) const;
  /// Whether the plane or cylinder that the face is cut from, moved by this, is where it was, to `within`; of
  /// other kinds not known [length].
  bool stays(const Vector3& shift, double within) const;
  /// Whether the range of an angle is a whole turn, to 1e-9.
  bool whole_turn(int direction) const;
  double middle(int direction) const { return 0.5 * (low[direction] + high[direction]); }

 private:
  // Of spheres and tori.
  double tube() const { return kind == Kind::torus ? r : R; }
  double ring() const { return kind == Kind::torus ? R : 0.0; }
  Vector3 radial(double angle) const { return std::cos(angle) * frame.x + std::sin(angle) * frame.y; }
};

}  // namespace brep

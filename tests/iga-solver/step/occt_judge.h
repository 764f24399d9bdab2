// SPDX-License-Identifier: GPL-2.0-or-later
// What OpenCASCADE alone says of a CAD file: distances from its faces, and what lies in a face or a solid.
// Shares nothing with our own reader.  Slow: about a millisecond a point.
#pragma once

#include <array>
#include <memory>
#include <string>

namespace step_parts {

using Point = std::array<double, 3>;  ///< mm

struct Nearest {
  double distance;  ///< mm
  Point point;
};

enum class Place { kIn, kOn, kOut, kUnknown };

/// Parameters that a face lies within: u and v, low and high.  OpenCASCADE's: angles in rad, lengths in mm.
struct Window {
  std::array<double, 2> u, v;
};

/// Faces and solids count from 0 in the order of TopExp::MapShapes, placed as in the assembly.  A face that
/// stands in two places counts twice.
class OcctJudge {
 public:
  /// STEP or, by the ending, IGES.  Throws std::runtime_error if there is no shape.
  explicit OcctJudge(const std::string& file);
  ~OcctJudge();

  int face_count() const;
  int solid_count() const;
  /// The largest of faces, edges and vertices, mm.
  double tolerance() const;
  double volume(int solid) const;  ///< mm^3
  double area(int face) const;     ///< mm^2

  /// From the faces (BRepExtrema_DistShapeShape), also from within a solid.
  Nearest nearest(const Point& point) const;
  Nearest nearest_on(int face, const Point& point) const;

  /// `tolerance` in mm.
  Place in_solid(int solid, const Point& point, double tolerance) const;

  Window window(int face) const;
  /// Of the surface, trimmed or not.
  Point value(int face, double u, double v) const;
  /// By BRepClass_FaceClassifier, with the tolerance in parameters.
  Place in_face(int face, double u, double v, double tolerance) const;
  /// By BRepTopAdaptor_FClass2d, which takes curves as polygons first; periodic parameters may lie in any
  /// period.
  Place in_face_by_polygon(int face, double u, double v) const;

 private:
  struct Shapes;
  std::unique_ptr<Shapes> shapes_;
};

}  // namespace step_parts

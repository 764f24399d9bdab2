// SPDX-License-Identifier: GPL-2.0-or-later
// What lies in a face or a solid of a CAD file by winding numbers: angles are summed along borders and over
// triangles.  Slow and plain; settles what classifiers disagree on.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "occt_judge.h"

namespace step_parts {

struct Winding {
  bool inside;
  double
      distance;  ///< from the border, mm: at most by so much from the nearest place where angles are summed
};

/// Faces and solids count as OcctJudge's.
class OcctWinding {
 public:
  explicit OcctWinding(const std::string& file);
  ~OcctWinding();

  /// OpenCASCADE's parameters of the point of a face's surface that is nearest.
  std::array<double, 2> parameters(int face, const Point& point) const;
  /// Along the curves of the face's own parameters, in any period.
  Winding in_face(int face, const Point& point) const;
  /// By the solid angles of triangles that are within chord() of the solid.
  bool in_solid(int solid, const Point& point) const;
  double chord() const;  ///< mm

 private:
  struct Shapes;
  std::unique_ptr<Shapes> shapes_;
};

}  // namespace step_parts

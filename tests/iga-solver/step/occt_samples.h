// SPDX-License-Identifier: GPL-2.0-or-later
// The distance from the faces of a CAD file by brute force: points all over the faces and along their
// borders, and from those that are near downhill on OpenCASCADE's surfaces and curves.  What it gives is the
// distance of a point of the wall, so never less than the least; it shares nothing with our own reader and
// search, nor with OpenCASCADE's Extrema, and takes a tenth of their time.
#pragma once

#include <memory>
#include <string>

#include "occt_judge.h"

namespace step_parts {
namespace samples {
struct Parts;
}

class OcctSamples {
 public:
  /// STEP or, by the ending, IGES.  Throws std::runtime_error if there is no shape.
  explicit OcctSamples(const std::string& file);
  ~OcctSamples();

  struct Found {
    double distance;  ///< mm
    bool inside;      ///< in a face, by OpenCASCADE's polygons round it; else on an edge, or a vertex
  };
  Found nearest(const Point& point) const;
  int count() const;  ///< of samples

 private:
  std::unique_ptr<samples::Parts> parts_;
};

}  // namespace step_parts

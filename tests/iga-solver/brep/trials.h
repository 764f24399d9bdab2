// SPDX-License-Identifier: GPL-2.0-or-later
// Random walls and points: the feet that FootSearch finds against the judge's.
#pragma once

#include <string>

#include "brep/builder.h"
#include "brep/foot_search.h"
#include "judge.h"

namespace brep::trials {

class Trial {
 public:
  Trial(unsigned seed, int index);
  const Wall& wall() const { return wall_; }
  const Surface& surface() const { return surface_; }
  /// What is wrong with the sheets, or an empty text.
  std::string try_sheets();
  /// The same for the feet of a point that is drawn; counts those found.
  std::string try_point(int number, long& feet);

 private:
  bool minimum_beside(const Vector3& d, double reach, const Foot& foot) const;
  std::string compare(const Vector3& d, double reach, const std::vector<Foot>& feet) const;

  std::mt19937 random_;
  Wall wall_;
  Surface surface_;
  FootSearch search_;
  Judge judge_;
  double uneven_ = 0.0;  // how far points are off the planes of their faces, below 1e-6 of the size
  std::vector<int> sheet_of_judge_;  // the wall's
  std::vector<int> near_, active_;
  std::vector<Foot> feet_, from_active_;
};

/// All feet of d, found without a list.
inline std::vector<Foot> feet(const Surface& surface, const Vector3& d, double reach) {
  const FootSearch search(surface);
  std::vector<int> near;
  std::vector<Foot> found;
  search.near(d, reach, near);
  search.feet(d, reach, near.data(), static_cast<int>(near.size()), found);
  return found;
}

}  // namespace brep::trials

// SPDX-License-Identifier: GPL-2.0-or-later
// A ball that is pressed on a wall and moved: springs of stiffness 1 along every foot's normal.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "brep/foot_search.h"

namespace brep::trials {

class Roller {
 public:
  /// Keeps a reference.
  Roller(const brep::Surface& wall, double radius) : search_(wall), radius_(radius) {}

  /// Greatest change of force per length, and of energy against work.
  struct Way {
    double slope = 0.0, energy_lost = 0.0;
    int most = 0, least = 100;  ///< contacts
  };
  /// On a straight way.
  Way along(const Vector3& from, const Vector3& to, int steps) {
    Way way;
    const Pressed start = at(from);
    Pressed last = start;
    double work = 0.0;
    for (int k = 1; k <= steps; ++k) {
      const double s = static_cast<double>(k) / steps;
      const Pressed now = at((1.0 - s) * from + s * to);
      way.slope = std::max(way.slope, (now.force - last.force).norm() * steps / (to - from).norm());
      work += 0.5 * (now.force + last.force).dot(to - from) / steps;
      way.most = std::max(way.most, now.contacts);
      way.least = std::min(way.least, now.contacts);
      last = now;
    }
    way.energy_lost = std::abs(last.energy - start.energy + work);
    return way;
  }

 private:
  struct Pressed {
    Vector3 force = Vector3::Zero();
    double energy = 0.0;
    int contacts = 0;
  };
  Pressed at(const Vector3& d) {
    near_.clear(), feet_.clear();
    search_.near(d, radius_, near_);
    search_.feet(d, radius_, near_.data(), static_cast<int>(near_.size()), feet_);
    Pressed sum;
    for (const Foot& foot : feet_) {
      const double overlap = radius_ - foot.distance;
      sum.force += overlap / foot.distance * (d - foot.point);
      sum.energy += 0.5 * overlap * overlap;
      ++sum.contacts;
    }
    return sum;
  }

  const FootSearch search_;
  double radius_;
  std::vector<int> near_;
  std::vector<Foot> feet_;
};

}  // namespace brep::trials

// SPDX-License-Identifier: GPL-2.0-or-later
#include "mixed_trial.h"

#include <fmt/format.h>

#include <set>

namespace brep::trials {

MixedTrial::MixedTrial(const std::vector<Face>& faces, const std::mt19937& random, Given given)
    : Trial(random, given_as(given, from_faces(faces))),
      faces_(faces),
      judge_(faces, surface_.edge_angle),
      sheet_of_judge_(2 * faces.size(), -1) {
  uneven_ = 1e-6;  // how far the judge may take a foot to the border of its face
  beside_ = 3e-5;  // beyond what counts as one point with the judge
}

std::string MixedTrial::try_sheets() {
  std::set<int> ours;
  for (int f = 0; f < static_cast<int>(faces_.size()); ++f)
    for (int side = 0; side < 2; ++side) {
      int& sheet = sheet_of_judge_[judge_.sheet(f, side)];
      const int now = surface_.sheet(f, side == 0 ? 1 : -1);
      if (sheet == -1 && !ours.insert(now).second) return fmt::format("one sheet is two at face {}", f);
      if (sheet >= 0 && sheet != now) return fmt::format("sheets differ at face {}", f);
      sheet = now;
    }
  return {};
}

}  // namespace brep::trials

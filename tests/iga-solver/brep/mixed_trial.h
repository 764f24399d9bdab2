// SPDX-License-Identifier: GPL-2.0-or-later
// Random walls of faces in closed form against their judge.
#pragma once

#include "mixed_judge.h"
#include "mixed_walls.h"
#include "trials.h"

namespace brep::trials {

class MixedTrial final : public Trial {
 public:
  MixedTrial(unsigned seed, int index, Given given = Given::plainly)
      : MixedTrial(seeded(seed, index), index, given) {}
  std::string try_sheets() override;

 private:
  MixedTrial(std::mt19937 random, int index, Given given)
      : MixedTrial(random_mixed_wall(random, index % kMixedFamilies), random, given) {}
  MixedTrial(const std::vector<Face>& faces, const std::mt19937& random, Given given);
  Vector3 draw(int place) override { return random_point(random_, faces_, place); }
  int sheet_of(const Minimum& minimum) const override { return sheet_of_judge_[minimum.sheet]; }
  const AnyJudge& judge() const override { return judge_; }

  std::vector<Face> faces_;
  MixedJudge judge_;
  std::vector<int> sheet_of_judge_;  // the wall's
};

}  // namespace brep::trials

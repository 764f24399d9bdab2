// SPDX-License-Identifier: GPL-2.0-or-later
// Pieces that are left for a point while it moves within a margin (FootSearch::activate_with_feet): wherever
// it goes they have the same feet as all that are near.  Exit code 1 if not.
#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "brep/edge_uses.h"
#include "brep/foot_search.h"
#include "cad_wall.h"
#include "tried_files.h"

namespace {

using brep::Foot;
using brep::Vector3;

class Trial {
 public:
  Trial(const std::string& file, unsigned seed)
      : wall_(step_parts::wall_of(step_parts::model_of(file))), search_(wall_), random_(seed) {}

  /// Beside every edge so many points.
  void run(int points) {
    for (int e = 0; e < static_cast<int>(wall_.edges.size()); ++e)
      for (int k = 0; k < points; ++k) {
        const double reach = wall_.size * std::pow(10.0, -2.5 + 1.5 * uniform()),
                     margin = reach * std::pow(10.0, -2.0 + 1.5 * uniform());
        const Vector3 on = brep::at_part(wall_, wall_.edges[e], uniform()).point;
        try_around(on + reach * std::cbrt(uniform()) * direction(), reach, margin);
      }
    fmt::print("{} points, {} pieces near, {} left; wrong: {}\n", points_, near_, left_, wrong_);
  }
  int wrong() const { return wrong_; }

 private:
  double uniform() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  Vector3 direction() {
    std::normal_distribution<double> normal;
    return Vector3(normal(random_), normal(random_), normal(random_)).normalized();
  }

  void try_around(const Vector3& d, double reach, double margin) {
    constexpr int kPlaces = 12;
    std::vector<int> all;
    search_.near(d, reach + 2.0 * margin + 2.0 * search_.border_slack(), all);
    std::vector<int> left(all.size());
    left.resize(search_.activate_with_feet(d, reach + margin, margin, all.data(),
                                           static_cast<int>(all.size()), left.data()));
    ++points_;
    near_ += static_cast<long>(all.size()), left_ += static_cast<long>(left.size());
    for (int k = 0; k < kPlaces; ++k) compare(d + margin * uniform() * direction(), reach, all, left);
  }

  // Feet of patches are followed from where their pieces are, so they end apart by round-off.
  void compare(const Vector3& d, double reach, const std::vector<int>& all, const std::vector<int>& left) {
    const double apart = search_.same_point() + 1e-9 * wall_.size, touch = reach * (1.0 - 1e-9);
    const std::vector<Foot> expected = feet(d, reach, all), found = feet(d, reach, left);
    const auto has = [&](const std::vector<Foot>& feet, const Foot& foot) {
      return foot.distance > touch || std::any_of(feet.begin(), feet.end(), [&](const Foot& other) {
               return other.sheet == foot.sheet && (other.point - foot.point).norm() <= apart;
             });
    };
    const auto all_of = [&](const std::vector<Foot>& some, const std::vector<Foot>& feet) {
      return std::all_of(some.begin(), some.end(), [&](const Foot& foot) { return has(feet, foot); });
    };
    if (all_of(expected, found) && all_of(found, expected)) return;
    if (++wrong_ > 10) return;
    fmt::print("  at ({:.9g}, {:.9g}, {:.9g}), reach {:.4g}: {} feet, {} of all pieces\n", d[0], d[1], d[2],
               reach, found.size(), expected.size());
  }

  std::vector<Foot> feet(const Vector3& d, double reach, const std::vector<int>& pieces) const {
    std::vector<Foot> feet;
    search_.feet(d, reach, pieces.data(), static_cast<int>(pieces.size()), feet);
    return feet;
  }

  const brep::Surface wall_;
  const brep::FootSearch search_;
  std::mt19937 random_;
  long points_ = 0, near_ = 0, left_ = 0;
  int wrong_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  step_parts::TriedFiles tried("Which pieces have feet of a point that moves a little", "beside every edge",
                               100);
  return tried.run(argc, argv, [&](const std::string& file) {
    Trial trial(file, tried.seed);
    trial.run(tried.points);
    return trial.wrong();
  });
}

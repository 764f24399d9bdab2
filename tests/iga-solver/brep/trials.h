// SPDX-License-Identifier: GPL-2.0-or-later
// Random walls and points: the feet that FootSearch finds against the judge's.
#pragma once

#include <string>

#include "brep/builder.h"
#include "brep/foot_search.h"
#include "judge.h"

namespace brep::trials {

/// How a wall is given to the search.
enum class Given { plainly, as_cad, as_patches };
Surface given_as(Given given, Surface wall);

class Trial {
 public:
  virtual ~Trial() = default;
  const Surface& surface() const { return surface_; }
  /// What is wrong with the sheets, or an empty text.
  virtual std::string try_sheets() = 0;
  /// The same for the feet of a point that is drawn; counts those found.
  std::string try_point(int number, long& feet);

 protected:
  Trial(std::mt19937 random, Surface surface);
  /// A point to be tried.
  virtual Vector3 draw(int place) = 0;
  /// The judge's sheets, as the wall counts them.
  virtual int sheet_of(const Minimum& minimum) const = 0;
  virtual const AnyJudge& judge() const = 0;

  std::mt19937 random_;
  Surface surface_;
  double uneven_ = 0.0;   // how far points may be off their faces
  double beside_ = 1e-6;  // how far a point is moved off a border
  bool rounded_ = false;  // points are off their faces, so what is on a border exactly may be on none

 private:
  bool lies_on_an_axis() const;
  bool found_beside(const Vector3& d, double reach, const Minimum& minimum) const;
  bool gives_way_beside(const Vector3& d, double reach, const Minimum& minimum,
                        const std::vector<Foot>& feet) const;
  bool twice_beside(const Vector3& d, double reach, const Foot& foot) const;
  bool minimum_beside(const Vector3& d, double reach, const Foot& foot) const;
  std::string compare(const Vector3& d, double reach, const std::vector<Foot>& feet) const;

  FootSearch search_;
  std::vector<int> near_, active_;
  std::vector<Foot> feet_, from_active_;
};

/// A random wall of triangles.
class TriangleTrial final : public Trial {
 public:
  TriangleTrial(unsigned seed, int index, Given given = Given::plainly);
  /// A surface that was made from the wall; `rounded`: by way of a file in single precision.
  TriangleTrial(const Wall& meant, const Surface& surface, bool rounded, const std::mt19937& random)
      : TriangleTrial(meant, surface, surface, rounded, random) {}
  /// The same whose faces are not of triangles; they have the numbers that the planes of triangles have.
  TriangleTrial(const Wall& meant, const Surface& surface, const std::mt19937& random)
      : TriangleTrial(meant, from_triangles(meant.coordinates(), meant.corners()), surface, false, random) {}
  std::string try_sheets() override;

 private:
  TriangleTrial(std::mt19937 random, int index, Given given);  // the wall is drawn first, then points
  TriangleTrial(const Wall& wall, const std::mt19937& random, Given given);
  TriangleTrial(const Wall& meant, Surface plain, Surface surface, bool rounded, const std::mt19937& random);
  int face_of(const Vector3& middle) const;
  Vector3 draw(int place) override { return random_point(random_, wall_, place); }
  int sheet_of(const Minimum& minimum) const override { return sheet_of_judge_[minimum.sheet]; }
  const AnyJudge& judge() const override { return judge_; }

  Wall wall_;
  Surface plain_;
  Judge judge_;
  std::vector<int> sheet_of_judge_;  // the wall's
};

/// A generator for one wall of a row.
std::mt19937 seeded(unsigned seed, int index);

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

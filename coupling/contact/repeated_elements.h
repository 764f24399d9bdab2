// SPDX-License-Identifier: GPL-2.0-or-later
// A wall that is longer than a periodic box lies on its own images.  Elements that do so are met once.
#pragma once

#include <vector>

#include "coupling/contact/wall_shape.h"

namespace contact {

class RepeatedElements {
 public:
  /// Keeps a reference; the shape stays as it is.
  explicit RepeatedElements(const WallShape& shape) : shape_(shape) {}

  /// Whether each of these elements is farther than `reach` from d or, moved by `shift`, is another one of
  /// the wall, to 1e-6 of its size.
  bool all(const nurbs::Vector3& shift, const nurbs::Vector3& d, double reach, const int* elements,
           int count);

 private:
  struct Ball {
    nurbs::Vector3 centre;
    double radius = -1.0;  // < 0: not known yet; infinite: nobody knows
  };
  enum Answer : signed char { kNotAsked, kYes, kNo };
  struct Shifted {
    nurbs::Vector3 shift;
    std::vector<Answer> answers;  // by element
  };
  const Ball& around(int element);
  std::vector<Answer>& answers(const nurbs::Vector3& shift);
  bool is_another(const nurbs::Vector3& shift, int element);

  const WallShape& shape_;
  std::vector<Ball> balls_;  // by element
  std::vector<Shifted> shifted_;
  std::vector<nurbs::Vector3> points_, others_;  // of one element, of another
  std::vector<int> near_;
};

}  // namespace contact

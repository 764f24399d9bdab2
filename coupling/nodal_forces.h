// SPDX-License-Identifier: GPL-2.0-or-later
// Forces on the nodes that a rank holds, few of which have any.
#pragma once

#include <utility>
#include <vector>

#include "nurbs/types.h"

namespace coupling {

using nurbs::NodalVectors;

struct NodalForces {
  NodalVectors values;                ///< 3 x nodes held, zero but at those of `touched` [force]
  std::vector<Eigen::Index> touched;  ///< columns, rising

  NodalForces() = default;
  /// Of a whole array: looks where it is not zero.
  explicit NodalForces(NodalVectors all) : values(std::move(all)) {
    for (Eigen::Index A = 0; A < values.cols(); ++A)
      if (!values.col(A).isZero(0.0)) touched.push_back(A);
  }
};

}  // namespace coupling

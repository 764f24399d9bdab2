// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <functional>

#include "nurbs/types.h"

namespace structure {

/// Of the place X in the undeformed body [length] and the time t.  Calls do not allocate.
using Field = std::function<nurbs::Vector3(const nurbs::Vector3& X, double t)>;

}  // namespace structure

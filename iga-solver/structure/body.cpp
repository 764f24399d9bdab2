// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/body.h"

#include <fmt/format.h>

namespace structure {

std::string text(const Vector3& x) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]); }

}  // namespace structure

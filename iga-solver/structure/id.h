// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>

namespace structure {

/// A node or an element of the whole body, counted from 0: the same however it is cut.
using Id = std::int64_t;

}  // namespace structure

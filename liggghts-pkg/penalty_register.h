// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace liggghts_pkg {

/// Makes the penalty laws known to LIGGGHTS, as `model` of `fix wall/gran`, of our walls and of `pair_style
/// gran`, with every combination of the other parts.  LIGGGHTS keeps these tables per process: call it once.
void register_penalty_models();

}  // namespace liggghts_pkg

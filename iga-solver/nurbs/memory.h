// SPDX-License-Identifier: GPL-2.0-or-later
// Whether something fits into memory, asked before it is allocated: a slip of the finger in a mesh would
// otherwise end with the process being killed without a word.
#pragma once

#include <string>

namespace nurbs {

/// What this process may take at most [bytes]: the machine's memory, or less where a limit is set (ulimit -v,
/// or that of a container).
double memory_limit();

/// Throws std::invalid_argument "WHAT would take N GB of memory, this process may have M GB" if it cannot
/// fit.
void expect_memory(double bytes, const std::string& what);

/// What is said where memory ends: "plate.yaml: out of memory: ...".
std::string out_of_memory(const std::string& file);

/// 1.5e9 -> "1.5 GB".
std::string size_text(double bytes);

}  // namespace nurbs

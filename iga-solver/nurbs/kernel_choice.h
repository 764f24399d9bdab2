// SPDX-License-Identifier: GPL-2.0-or-later
// Kernels that are compiled once for each instruction set, in namespaces of these names.
#pragma once

#include <fmt/format.h>

#include <stdexcept>

#include "nurbs/simd_level.h"

namespace nurbs {

/// That of `level`; throws std::invalid_argument if it is not available.
template <class Function>
Function* kernel_of(SimdLevel level, Function* portable, Function* avx2 = nullptr,
                    Function* avx512 = nullptr) {
  if (!available(level))
    throw std::invalid_argument(fmt::format("this machine or this program has no {} kernels", name(level)));
  return level == SimdLevel::avx512 ? avx512 : level == SimdLevel::avx2 ? avx2 : portable;
}

}  // namespace nurbs

/// NURBS_KERNEL_OF(level, f): portable::f, avx2::f or avx512::f.
#ifdef NURBS_X86_64
#define NURBS_KERNEL_OF(level, function) \
  nurbs::kernel_of(level, portable::function, avx2::function, avx512::function)
#else
#define NURBS_KERNEL_OF(level, function) nurbs::kernel_of(level, portable::function)
#endif

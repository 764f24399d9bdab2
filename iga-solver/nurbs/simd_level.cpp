// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/simd_level.h"

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace nurbs {

namespace {
constexpr SimdLevel kHighestFirst[] = {SimdLevel::avx512, SimdLevel::avx2, SimdLevel::portable};
}

const char* name(SimdLevel level) {
  constexpr const char* kNames[] = {"portable", "avx2", "avx512"};
  return kNames[static_cast<int>(level)];
}

bool available(SimdLevel level) {
#ifdef NURBS_X86_64
  if (level == SimdLevel::avx2) return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (level == SimdLevel::avx512)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("fma");
#endif
  return level == SimdLevel::portable;
}

SimdLevel simd_level() {
  const char* wanted = std::getenv("LIGGGHTS_NURBS_SIMD");
  for (const SimdLevel level : kHighestFirst) {
    if (wanted == nullptr ? !available(level) : std::string(wanted) != name(level)) continue;
    if (!available(level))
      throw std::invalid_argument(fmt::format(
          "LIGGGHTS_NURBS_SIMD is \"{}\", which this machine or this program does not have", wanted));
    return level;
  }
  throw std::invalid_argument(
      fmt::format("LIGGGHTS_NURBS_SIMD is \"{}\", expected portable, avx2 or avx512", wanted));
}

}  // namespace nurbs

// SPDX-License-Identifier: GPL-2.0-or-later
// The kernels of power_kernel.cpp, which is compiled once for each instruction set.
#include <fmt/format.h>

#include <stdexcept>

#include "search/power_kernel.h"

namespace search {

namespace portable {
ElementKernel element_kernel(int p, int q, bool rational);
}
namespace avx2 {
ElementKernel element_kernel(int p, int q, bool rational);
}
namespace avx512 {
ElementKernel element_kernel(int p, int q, bool rational);
}

ElementKernel element_kernel(int p, int q, bool rational, SimdLevel level) {
  if (!available(level))
    throw std::invalid_argument(fmt::format("this machine or this program has no {} kernels", name(level)));
#ifdef NURBS_X86_64
  if (level == SimdLevel::avx512) return avx512::element_kernel(p, q, rational);
  if (level == SimdLevel::avx2) return avx2::element_kernel(p, q, rational);
#endif
  return portable::element_kernel(p, q, rational);
}

}  // namespace search

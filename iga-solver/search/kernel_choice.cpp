// SPDX-License-Identifier: GPL-2.0-or-later
// The kernels of power_kernel.cpp, which is compiled once for each instruction set.
#include "nurbs/kernel_choice.h"
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
  return NURBS_KERNEL_OF(level, element_kernel)(p, q, rational);
}

}  // namespace search

// SPDX-License-Identifier: GPL-2.0-or-later
// The kernels of feet_kernel.cpp, which is compiled once for each instruction set.
#include <fmt/format.h>

#include <stdexcept>

#include "coupling/contact/feet_kernel.h"

namespace contact {

namespace portable {
FeetKernel feet_kernel();
}
namespace avx2 {
FeetKernel feet_kernel();
}
namespace avx512 {
FeetKernel feet_kernel();
}

FeetKernel feet_kernel(nurbs::SimdLevel level) {
  if (!nurbs::available(level))
    throw std::invalid_argument(
        fmt::format("this machine or this program has no {} kernels", nurbs::name(level)));
#ifdef NURBS_X86_64
  if (level == nurbs::SimdLevel::avx512) return avx512::feet_kernel();
  if (level == nurbs::SimdLevel::avx2) return avx2::feet_kernel();
#endif
  return portable::feet_kernel();
}

}  // namespace contact

// SPDX-License-Identifier: GPL-2.0-or-later
// The kernel of table_kernel.cpp, which is compiled once for each instruction set.
#include <fmt/format.h>

#include <stdexcept>

#include "structure/compliance/table_kernel.h"

namespace structure {

namespace portable {
TableKernel table_kernel();
}
namespace avx2 {
TableKernel table_kernel();
}
namespace avx512 {
TableKernel table_kernel();
}

TableKernel table_kernel(nurbs::SimdLevel level) {
  if (!nurbs::available(level))
    throw std::invalid_argument(
        fmt::format("this machine or this program has no {} kernels", nurbs::name(level)));
#ifdef NURBS_X86_64
  if (level == nurbs::SimdLevel::avx512) return avx512::table_kernel();
  if (level == nurbs::SimdLevel::avx2) return avx2::table_kernel();
#endif
  return portable::table_kernel();
}

}  // namespace structure

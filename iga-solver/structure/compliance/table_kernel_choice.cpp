// SPDX-License-Identifier: GPL-2.0-or-later
// The kernel of table_kernel.cpp, which is compiled once for each instruction set.
#include "nurbs/kernel_choice.h"
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

TableKernel table_kernel(nurbs::SimdLevel level) { return NURBS_KERNEL_OF(level, table_kernel)(); }

}  // namespace structure

// SPDX-License-Identifier: GPL-2.0-or-later
#include "machine_kernels.h"
#include "nurbs/simd_level.h"

namespace benchmarks {

namespace portable {
extern const MachineKernels kKernels;
}
namespace avx2 {
extern const MachineKernels kKernels;
}
namespace avx512 {
extern const MachineKernels kKernels;
}

const MachineKernels& machine_kernels() {
  switch (nurbs::simd_level()) {
#ifdef NURBS_X86_64
    case nurbs::SimdLevel::avx512:
      return avx512::kKernels;
    case nurbs::SimdLevel::avx2:
      return avx2::kKernels;
#endif
    default:
      return portable::kKernels;
  }
}

}  // namespace benchmarks

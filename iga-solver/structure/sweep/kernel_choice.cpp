// SPDX-License-Identifier: GPL-2.0-or-later
// The kernels of field_kernel.cpp, line_kernel.cpp, mass_kernel.cpp and point_kernel.cpp, which are compiled
// once for each instruction set.
#include "nurbs/kernel_choice.h"
#include "structure/sweep/field_kernel.h"
#include "structure/sweep/line_kernel.h"
#include "structure/sweep/mass_kernel.h"
#include "structure/sweep/point_kernel.h"

namespace structure {

using nurbs::SimdLevel;

#define DECLARE_KERNELS(level)                                     \
  namespace level {                                                \
  const FieldKernel& field_kernel();                               \
  const LineKernel& line_kernel(int degree);                       \
  const MassKernel& mass_kernel();                                 \
  const PointLoops& point_loops(GeometryMode mode, bool rational); \
  const PointLoops& aligned_loops(int shift);                      \
  const GeometryLoops& geometry_loops(bool rational);              \
  }
DECLARE_KERNELS(portable)
DECLARE_KERNELS(avx2)
DECLARE_KERNELS(avx512)
#undef DECLARE_KERNELS

const FieldKernel& field_kernel(SimdLevel level) { return NURBS_KERNEL_OF(level, field_kernel)(); }

const LineKernel& line_kernel(int degree, SimdLevel level) {
  return NURBS_KERNEL_OF(level, line_kernel)(degree);
}

const MassKernel& mass_kernel(SimdLevel level) { return NURBS_KERNEL_OF(level, mass_kernel)(); }

const PointLoops& point_loops(GeometryMode mode, bool rational, SimdLevel level) {
  return NURBS_KERNEL_OF(level, point_loops)(mode, rational);
}

const PointLoops& aligned_loops(int shift, SimdLevel level) {
  return NURBS_KERNEL_OF(level, aligned_loops)(shift);
}

const GeometryLoops& geometry_loops(bool rational, SimdLevel level) {
  return NURBS_KERNEL_OF(level, geometry_loops)(rational);
}

}  // namespace structure

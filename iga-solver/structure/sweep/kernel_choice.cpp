// SPDX-License-Identifier: GPL-2.0-or-later
// The kernels of field_kernel.cpp, line_kernel.cpp, mass_kernel.cpp and point_kernel.cpp, which are compiled
// once for each instruction set.
#include <fmt/format.h>

#include <stdexcept>

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

namespace {
void expect(SimdLevel level) {
  if (!nurbs::available(level))
    throw std::invalid_argument(
        fmt::format("this machine or this program has no {} kernels", nurbs::name(level)));
}
}  // namespace

const FieldKernel& field_kernel(SimdLevel level) {
  expect(level);
#ifdef NURBS_X86_64
  if (level == SimdLevel::avx512) return avx512::field_kernel();
  if (level == SimdLevel::avx2) return avx2::field_kernel();
#endif
  return portable::field_kernel();
}

const LineKernel& line_kernel(int degree, SimdLevel level) {
  expect(level);
#ifdef NURBS_X86_64
  if (level == SimdLevel::avx512) return avx512::line_kernel(degree);
  if (level == SimdLevel::avx2) return avx2::line_kernel(degree);
#endif
  return portable::line_kernel(degree);
}

const MassKernel& mass_kernel(SimdLevel level) {
  expect(level);
#ifdef NURBS_X86_64
  if (level == SimdLevel::avx512) return avx512::mass_kernel();
  if (level == SimdLevel::avx2) return avx2::mass_kernel();
#endif
  return portable::mass_kernel();
}

const PointLoops& point_loops(GeometryMode mode, bool rational, SimdLevel level) {
  expect(level);
#ifdef NURBS_X86_64
  if (level == SimdLevel::avx512) return avx512::point_loops(mode, rational);
  if (level == SimdLevel::avx2) return avx2::point_loops(mode, rational);
#endif
  return portable::point_loops(mode, rational);
}

const PointLoops& aligned_loops(int shift, SimdLevel level) {
  expect(level);
#ifdef NURBS_X86_64
  if (level == SimdLevel::avx512) return avx512::aligned_loops(shift);
  if (level == SimdLevel::avx2) return avx2::aligned_loops(shift);
#endif
  return portable::aligned_loops(shift);
}

const GeometryLoops& geometry_loops(bool rational, SimdLevel level) {
  expect(level);
#ifdef NURBS_X86_64
  if (level == SimdLevel::avx512) return avx512::geometry_loops(rational);
  if (level == SimdLevel::avx2) return avx2::geometry_loops(rational);
#endif
  return portable::geometry_loops(rational);
}

}  // namespace structure

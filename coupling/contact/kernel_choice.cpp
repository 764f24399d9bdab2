// SPDX-License-Identifier: GPL-2.0-or-later
// The kernels of *_kernel.cpp, which are compiled once for each instruction set.
#include <fmt/format.h>

#include <stdexcept>

#include "coupling/contact/approach_kernel.h"
#include "coupling/contact/face_kernel.h"
#include "coupling/contact/feet_kernel.h"
#include "coupling/contact/shear_kernel.h"

namespace contact {

namespace portable {
FeetKernel feet_kernel();
FaceKernel face_kernel();
ApproachKernel approach_kernel();
ShearKernel shear_kernel();
}  // namespace portable
namespace avx2 {
FeetKernel feet_kernel();
FaceKernel face_kernel();
ApproachKernel approach_kernel();
ShearKernel shear_kernel();
}  // namespace avx2
namespace avx512 {
FeetKernel feet_kernel();
FaceKernel face_kernel();
ApproachKernel approach_kernel();
ShearKernel shear_kernel();
}  // namespace avx512

namespace {

template <class Kernel>
struct Kernels {
  Kernel (*portable)();
  Kernel (*avx2)() = nullptr;
  Kernel (*avx512)() = nullptr;

  Kernel of(nurbs::SimdLevel level) const {
    if (!nurbs::available(level))
      throw std::invalid_argument(
          fmt::format("this machine or this program has no {} kernels", nurbs::name(level)));
    return level == nurbs::SimdLevel::avx512 ? avx512()
           : level == nurbs::SimdLevel::avx2 ? avx2()
                                             : portable();
  }
};

#ifdef NURBS_X86_64
constexpr Kernels<FeetKernel> kFeet = {portable::feet_kernel, avx2::feet_kernel, avx512::feet_kernel};
constexpr Kernels<FaceKernel> kFaces = {portable::face_kernel, avx2::face_kernel, avx512::face_kernel};
constexpr Kernels<ApproachKernel> kApproaches = {portable::approach_kernel, avx2::approach_kernel,
                                                 avx512::approach_kernel};
constexpr Kernels<ShearKernel> kShears = {portable::shear_kernel, avx2::shear_kernel, avx512::shear_kernel};
#else
constexpr Kernels<FeetKernel> kFeet = {portable::feet_kernel};
constexpr Kernels<FaceKernel> kFaces = {portable::face_kernel};
constexpr Kernels<ApproachKernel> kApproaches = {portable::approach_kernel};
constexpr Kernels<ShearKernel> kShears = {portable::shear_kernel};
#endif

}  // namespace

FeetKernel feet_kernel(nurbs::SimdLevel level) { return kFeet.of(level); }
FaceKernel face_kernel(nurbs::SimdLevel level) { return kFaces.of(level); }
ApproachKernel approach_kernel(nurbs::SimdLevel level) { return kApproaches.of(level); }
ShearKernel shear_kernel(nurbs::SimdLevel level) { return kShears.of(level); }

}  // namespace contact

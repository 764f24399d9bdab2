// SPDX-License-Identifier: GPL-2.0-or-later
// The kernels of *_kernel.cpp, which are compiled once for each instruction set.
#include "nurbs/kernel_choice.h"
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

FeetKernel feet_kernel(nurbs::SimdLevel level) { return NURBS_KERNEL_OF(level, feet_kernel)(); }
FaceKernel face_kernel(nurbs::SimdLevel level) { return NURBS_KERNEL_OF(level, face_kernel)(); }
ApproachKernel approach_kernel(nurbs::SimdLevel level) { return NURBS_KERNEL_OF(level, approach_kernel)(); }
ShearKernel shear_kernel(nurbs::SimdLevel level) { return NURBS_KERNEL_OF(level, shear_kernel)(); }

}  // namespace contact

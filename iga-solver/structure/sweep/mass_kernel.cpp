// SPDX-License-Identifier: GPL-2.0-or-later
// Compiled once for each instruction set; see line_kernel.cpp for what that forbids.
#include "structure/sweep/mass_kernel.h"

#include "nurbs/lanes.h"

namespace structure {

using namespace nurbs::lanes;

namespace {

void gather_rows(const double* factors, int terms, const double* in, std::size_t step, std::size_t count,
                 double* out) {
  for (std::size_t i = 0; i < count; i += kLanes) {
    Lanes sum = factors[0] * load(in + i);
    for (int a = 1; a < terms; ++a) sum += factors[a] * load(in + a * step + i);
    store(sum, out + i);
  }
}

void scatter_rows(const double* factors, int terms, const double* in, std::size_t count, double* out,
                  std::size_t step) {
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Lanes value = load_once(in + i);
    for (int a = 0; a < terms; ++a) {
      double* const at = out + a * step + i;
      store(load(at) + factors[a] * value, at);
    }
  }
}

void multiply_band(const double* bands, std::size_t step, int width, const double* in, std::size_t count,
                   double* out) {
  for (std::size_t i = 0; i < count; i += kLanes) {
    Lanes sum = load(bands + i) * load(in + i);
    for (int k = 1; k <= width; ++k) {
      const double* const band = bands + k * step + i;
      sum += load(band) * load(in + i + k);
      sum += load(band - k) * load(in + i - k);
    }
    store(sum, out + i);
  }
}

constexpr MassKernel kMassKernel = {gather_rows, scatter_rows, multiply_band};

}  // namespace

namespace NURBS_SIMD_LEVEL {
const MassKernel& mass_kernel() { return kMassKernel; }
}  // namespace NURBS_SIMD_LEVEL

}  // namespace structure

// SPDX-License-Identifier: GPL-2.0-or-later
// The entries that libFuzzer calls, and the errors that are answers.
#include <cstddef>
#include <cstdint>

#include "fuzz_target.h"
#include "geometry_io/input_error.h"
#include "geometry_io/shape_limits.h"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  geometry_io::shape_limits() = {300, 1e4};
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    fuzz_one(std::string(reinterpret_cast<const char*>(data), size));
  } catch (const geometry_io::InputError& error) {
    check_that(std::string(error.what()).find('\n') == std::string::npos);
  } catch (const std::invalid_argument&) {
  }
  return 0;
}

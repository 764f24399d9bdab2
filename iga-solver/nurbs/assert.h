// SPDX-License-Identifier: GPL-2.0-or-later
// Assertions on shapes and ranges: what only a fault of this project breaks.  What a user can break is
// refused with std::invalid_argument or InputError, in every build.
#pragma once

#ifdef NURBS_ASSERTIONS
#include <sstream>
#include <stdexcept>
#endif

/// NURBS_ASSERT(condition, values...): builds with assertions (CMake: LIGGGHTS_NURBS_ASSERTIONS) throw
/// nurbs::AssertionFailed with file, line, the condition and the values, which are numbers, unless the
/// condition holds.  Elsewhere nothing is evaluated: it is free.
#ifdef NURBS_ASSERTIONS
#define NURBS_ASSERT(condition, ...)                                                                      \
  (static_cast<bool>(condition) ? void()                                                                  \
                                : ::nurbs::assertion_failed(__FILE__, __LINE__, #condition, #__VA_ARGS__, \
                                                            ::nurbs::as_doubles(__VA_ARGS__)))
#else
#define NURBS_ASSERT(condition, ...) static_cast<void>(sizeof(static_cast<bool>(condition)))
#endif

#ifdef NURBS_ASSERTIONS
namespace nurbs {

class AssertionFailed : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

template <int N>
struct AssertedValues {
  double values[N];
};
template <class... Numbers>
AssertedValues<static_cast<int>(sizeof...(Numbers))> as_doubles(Numbers... numbers) {
  return {{static_cast<double>(numbers)...}};
}

template <int N>
[[noreturn]] void assertion_failed(const char* file, int line, const char* condition, const char* names,
                                   const AssertedValues<N>& asserted) {
  std::ostringstream message;
  message.precision(17);
  message << file << ':' << line << ": expected " << condition << "; (" << names << ") = (";
  for (int k = 0; k < N; ++k) message << (k > 0 ? ", " : "") << asserted.values[k];
  message << ')';
  throw AssertionFailed(message.str());
}

}  // namespace nurbs
#endif

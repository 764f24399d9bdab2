// SPDX-License-Identifier: GPL-2.0-or-later
// What every fuzz target is: a function of a text that may throw what a reader of users' texts may throw, and
// nothing else.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

/// Written by each target.
void fuzz_one(const std::string& input);

/// Ends the program, as a sanitizer does, if something is not so.
#define check_that(condition) (condition) ? static_cast<void>(0) : fail_check(#condition)
[[noreturn]] inline void fail_check(const char* condition) {
  std::fprintf(stderr, "expected: %s\n", condition);
  std::abort();
}

// SPDX-License-Identifier: GPL-2.0-or-later
// What the commands of this folder do alike: words of the command line, errors, the exit code.
#pragma once

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <string>

#include "nurbs/memory.h"

namespace app {

inline int print_error(const std::string& message) {
  fmt::print(stderr, "ERROR: {}\n", message);
  return 1;
}

/// Parses the command line and calls run(), which works on `file`.  The exit code: 0, or 1 after an error,
/// which is printed.
template <class Run>
int run_command(CLI::App& command, int argc, char** argv, const std::string& file, Run run) {
  try {
    command.parse(argc, argv);
    run();
  } catch (const CLI::Success& success) {  // help
    return command.exit(success);
  } catch (const std::bad_alloc&) {
    return print_error(nurbs::out_of_memory(file));
  } catch (const std::exception& error) {
    return print_error(error.what());
  }
  return 0;
}

}  // namespace app

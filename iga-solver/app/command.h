// SPDX-License-Identifier: GPL-2.0-or-later
// What the commands of this folder do alike: words of the command line, errors, the exit code.
#pragma once

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>

namespace app {

/// Parses the command line and calls run().  The exit code: 0, or 1 after an error, which is printed.
template <class Run>
int run_command(CLI::App& command, int argc, char** argv, Run run) {
  try {
    command.parse(argc, argv);
    run();
  } catch (const CLI::Success& success) {  // help
    return command.exit(success);
  } catch (const std::exception& error) {
    fmt::print(stderr, "ERROR: {}\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace app

// SPDX-License-Identifier: GPL-2.0-or-later
// What the commands of this folder do alike: words of the command line, errors, the exit code.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "geometry_io/yaml_map.h"
#include "nurbs/memory.h"

namespace app {

inline int print_error(const std::string& message) {
  fmt::print(stderr, "ERROR: {}\n", message);
  return 1;
}

/// A number > 0, for an option.
inline std::string positive_number(const std::string& text) {
  double value = 0.0;
  return CLI::detail::lexical_cast(text, value) && value > 0.0
             ? ""
             : fmt::format("is '{}', expected a number > 0", text);
}

/// What the command does not know, with the option that was probably meant.
inline std::string unexpected_words(const CLI::App& command) {
  std::vector<std::string> known, words = command.remaining();
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  const std::string near = words.empty() ? "" : geometry_io::nearest_word(words.front(), known);
  return fmt::format("'{}' was not expected{}", fmt::join(words, " "),
                     near.empty() ? "; --help lists what is" : fmt::format(", did you mean '{}'?", near));
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
  } catch (const CLI::ExtrasError&) {
    return print_error(unexpected_words(command));
  } catch (const std::bad_alloc&) {
    return print_error(nurbs::out_of_memory(file));
  } catch (const std::exception& error) {
    return print_error(error.what());
  }
  return 0;
}

}  // namespace app

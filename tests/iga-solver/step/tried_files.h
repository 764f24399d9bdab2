// SPDX-License-Identifier: GPL-2.0-or-later
// CAD files that a program tries one after the other.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;  // its header takes ten seconds to compile: it is in tried_files.cpp alone
}

namespace step_parts {

/// The words of a command line: files; if the program asks for it, how many points, and which.
class TriedFiles {
 public:
  explicit TriedFiles(const std::string& what);
  TriedFiles(const std::string& what, const std::string& points_of, int points_unless_told);
  ~TriedFiles();

  void add_flag(const std::string& name, bool& is_there, const std::string& meaning);
  /// One of `words`; what `word` is now if the line does not say.
  void add_choice(const std::string& name, std::string& word, const std::vector<std::string>& words,
                  const std::string& meaning);

  /// Parses the line and tries each file: `attempt(file)` says how much of it was wrong, an exception is one
  /// more.  The exit code.
  int run(int argc, char** argv, const std::function<long(const std::string& file)>& attempt);

  int points = 0;
  unsigned seed = 1;

 private:
  std::unique_ptr<CLI::App> app_;
  std::vector<std::string> files_;
};

}  // namespace step_parts

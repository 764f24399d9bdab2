// SPDX-License-Identifier: GPL-2.0-or-later
#include "tried_files.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>

namespace step_parts {

TriedFiles::TriedFiles(const std::string& what) : app_(std::make_unique<CLI::App>(what)) {
  app_->add_option("files", files_, "STEP or IGES")->required();
}

TriedFiles::TriedFiles(const std::string& what, const std::string& points_of, int points_unless_told)
    : TriedFiles(what) {
  points = points_unless_told;
  app_->add_option("--points", points, points_of);
  app_->add_option("--seed", seed, "of the random numbers");
}

TriedFiles::~TriedFiles() = default;

void TriedFiles::add_flag(const std::string& name, bool& is_there, const std::string& meaning) {
  app_->add_flag(name, is_there, meaning);
}

void TriedFiles::add_choice(const std::string& name, std::string& word, const std::vector<std::string>& words,
                            const std::string& meaning) {
  app_->add_option(name, word, meaning)->check(CLI::IsMember(words));
}

int TriedFiles::run(int argc, char** argv, const std::function<long(const std::string& file)>& attempt) {
  CLI11_PARSE(*app_, argc, argv);
  long wrong = 0;
  for (const std::string& file : files_) {
    try {
      fmt::print("{}: ", file);
      wrong += attempt(file);
    } catch (const std::exception& error) {
      fmt::print("{}\n", error.what());
      ++wrong;
    }
  }
  return wrong == 0 ? 0 : 1;
}

}  // namespace step_parts

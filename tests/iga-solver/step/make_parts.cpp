// SPDX-License-Identifier: GPL-2.0-or-later
// CAD files for tests: make_step_parts FOLDER [FILE...] writes all parts of parts.h, or the named ones, and
// external.step: nested.step with its solids in files of their own; make_step_parts --stl FILE.step DEVIATION
// FILE.stl triangles (mm); make_step_parts --look FILE... prints what OpenCASCADE sees in a file.
#include <Standard_Failure.hxx>
#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "look.h"
#include "write_files.h"

namespace {

using namespace step_parts;

using Names = std::vector<std::string>;

bool wanted(const std::string& file, const Names& only) {
  return only.empty() || std::find(only.begin(), only.end(), file) != only.end();
}

template <class List>
void write_all(const List& list, const std::string& folder, const Names& only) {
  for (const auto& part : list) {
    if (wanted(part.file, only)) write(part, folder);
  }
}

void write_all(const std::string& folder, const Names& only) {
  for (const auto& list :
       {closed_form_parts(), trimmed_parts(), spline_parts(), blended_parts(), border_parts()}) {
    write_all(list, folder, only);
  }
  write_all(assemblies(), folder, only);
  if (wanted("external.step", only)) write_by_reference(assemblies()[0], folder + "/external.step");
}

int run(const std::vector<std::string>& words) {
  if (words.size() == 4 && words[0] == "--stl") {
    write_stl(words[1], std::stod(words[2]), words[3]);
  } else if (words.size() > 1 && words[0] == "--look") {
    for (std::size_t i = 1; i < words.size(); ++i) look(words[i], std::cout);
  } else if (!words.empty() && words[0][0] != '-') {
    write_all(words[0], {words.begin() + 1, words.end()});
  } else {
    std::cerr
        << "usage: make_step_parts FOLDER [FILE...] | --stl FILE.step DEVIATION FILE.stl | --look FILE...\n";
    return 2;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const Standard_Failure& failure) {
    std::cerr << "make_step_parts: " << failure.DynamicType()->Name() << ": " << failure.GetMessageString()
              << '\n';
  } catch (const std::exception& error) {
    std::cerr << "make_step_parts: " << error.what() << '\n';
  }
  return 1;
}

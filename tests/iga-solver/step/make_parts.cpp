// SPDX-License-Identifier: GPL-2.0-or-later
// CAD files for tests: make_step_parts FOLDER [FILE...] writes all parts of parts.h, or the named ones and,
// if none is named, nested.step again with its solids in files of their own (external.step);
// make_step_parts --stl FILE.step DEVIATION FILE.stl triangles; make_step_parts --look FILE... what is in a
// file.
#include <Standard_Failure.hxx>
#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "look.h"
#include "write_files.h"

namespace {

using namespace step_parts;

template <class List>
void write_all(const List& list, const std::string& folder, const std::vector<std::string>& only) {
  for (const auto& part : list) {
    if (only.empty() || std::find(only.begin(), only.end(), part.file) != only.end()) write(part, folder);
  }
}

int run(const std::vector<std::string>& words) {
  if (words.size() == 4 && words[0] == "--stl") {
    write_stl(words[1], std::stod(words[2]), words[3]);
  } else if (words.size() > 1 && words[0] == "--look") {
    for (std::size_t i = 1; i < words.size(); ++i) look(words[i], std::cout);
  } else if (!words.empty() && words[0][0] != '-') {
    const std::vector<std::string> only(words.begin() + 1, words.end());
    for (const auto& list :
         {closed_form_parts(), trimmed_parts(), spline_parts(), blended_parts(), border_parts()}) {
      write_all(list, words[0], only);
    }
    write_all(assemblies(), words[0], only);
    if (only.empty()) write_by_reference(assemblies()[0], words[0] + "/external.step");
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

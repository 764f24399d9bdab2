// SPDX-License-Identifier: GPL-2.0-or-later
#include "output_words.h"

#include <algorithm>

namespace liggghts_pkg {

namespace {

using Selection = coupling::SurfaceFields::Selection;

const std::vector<std::string> kFieldWords = {"pressure", "shear", "contact_count", "wear"};
constexpr bool Selection::*kFields[] = {&Selection::pressure, &Selection::shear, &Selection::contact_count,
                                        &Selection::wear};

Selection read_fields(WordReader& words) {
  Selection selection{false, false, false, false};
  do {
    const std::string word = words.value_of("output fields", kFieldWords);
    selection.*kFields[std::find(kFieldWords.begin(), kFieldWords.end(), word) - kFieldWords.begin()] = true;
  } while (words.next_is_one_of(kFieldWords));
  return selection;
}

}  // namespace

OutputOptions read_output(WordReader& words) {
  OutputOptions options;
  options.file = words.value("the name of the files without .pvd");
  words.expect("every");
  options.every = words.count("output every", "a number of steps");
  if (words.next_is_one_of({"fields"})) {
    words.keyword();
    options.fields = read_fields(words);
  }
  if (words.next_is_one_of({"average"}))
    options.average = words.value_of(words.keyword(), {"yes", "no"}) == "yes";
  return options;
}

}  // namespace liggghts_pkg

// SPDX-License-Identifier: GPL-2.0-or-later
#include "output_words.h"

#include <fmt/format.h>

#include <stdexcept>

#include "keyword_table.h"

namespace liggghts_pkg {

namespace {

using Selection = coupling::ContactFields::Selection;

struct OutputField {
  const char* word;
  bool Selection::*selected;
};
constexpr OutputField kOutputFields[] = {
    {"pressure", &Selection::pressure},
    {"shear", &Selection::shear},
    {"contact_count", &Selection::contact_count},
    {"wear", &Selection::wear},
};

Selection read_fields(WordReader& words) {
  const std::vector<std::string> known = words_of(kOutputFields);
  Selection selection{false, false, false, false};
  do {
    selection.*find_row(kOutputFields, words.value_of("output fields", known))->selected = true;
  } while (words.next_is_one_of(known));
  return selection;
}

}  // namespace

void expect_no_way_back(const std::string& keyword, const std::string& file, std::optional<long> written,
                        long step) {
  if (!written || step >= *written) return;
  throw std::runtime_error(fmt::format(
      "'{} {}' has written step {}, a run begins at {} and would write over its files: expected no "
      "reset_timestep back, or the fix defined anew, after unfix, with another name",
      keyword, file, *written, step));
}

std::vector<std::string> output_fields() { return words_of(kOutputFields); }

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

StlOptions read_stl(WordReader& words) {
  StlOptions options;
  options.file = words.value("the name of the files without _<step>.stl");
  words.expect("every");
  options.every = words.count("stl every", "a number of steps");
  if (words.next_is_one_of({"chord"})) {
    words.keyword();
    options.chord = words.number_above_zero("stl chord");
  }
  return options;
}

}  // namespace liggghts_pkg

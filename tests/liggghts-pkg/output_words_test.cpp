// SPDX-License-Identifier: GPL-2.0-or-later
#include "output_words.h"

#include <gmock/gmock.h>

#include <sstream>
#include <stdexcept>

namespace {

using liggghts_pkg::OutputOptions;
using testing::HasSubstr;

std::vector<std::string> split(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// The options of the words after `output`, which end where `type` stands.
OutputOptions parse(const std::string& text) {
  const std::vector<std::string> words = split(text);
  liggghts_pkg::WordReader reader(words, 0);
  const OutputOptions options = liggghts_pkg::read_output(reader);
  EXPECT_TRUE(reader.at_end() || reader.next_is_one_of({"type"})) << text;
  return options;
}

TEST(OutputWords, HaveDefaults) {
  const OutputOptions options = parse("out/plate every 100");
  EXPECT_EQ(options.file, "out/plate");
  EXPECT_EQ(options.every, 100);
  EXPECT_TRUE(options.fields.pressure && options.fields.shear && options.fields.contact_count);
  EXPECT_FALSE(options.fields.wear) << "it needs Finnie's constants";
  EXPECT_TRUE(options.average);
}

TEST(OutputWords, SelectFieldsAndAverage) {
  const OutputOptions options = parse("wall every 5 fields wear pressure average no type 2");
  EXPECT_TRUE(options.fields.pressure && options.fields.wear);
  EXPECT_FALSE(options.fields.shear || options.fields.contact_count);
  EXPECT_FALSE(options.average);
  EXPECT_FALSE(parse("wall every 5 fields shear type 2").fields.pressure);
}

TEST(OutputWords, SayWhatIsWrong) {
  const auto expect = [](const std::string& words, const std::string& message) {
    EXPECT_THAT([&] { parse(words); }, testing::ThrowsMessage<std::invalid_argument>(HasSubstr(message)))
        << words;
  };
  expect("every 100", "'100' stands where 'every' is expected");
  expect("wall each 5", "'each' stands where 'every' is expected");
  expect("wall", "'wall' is the last word, expected 'every' after it");
  expect("wall every", "'every' is the last word, expected a number of steps after it");
  expect("wall every 0", "output every is '0', expected a number of steps, 1 or more");
  expect("wall every 1e3", "output every is '1e3', expected a number of steps, 1 or more");
  expect("wall every 5 fields",
         "'fields' is the last word, expected 'pressure' or 'shear' or 'contact_count' or 'wear' after it");
  expect("wall every 5 fields stress", "output fields is 'stress', expected 'pressure' or 'shear'");
  expect("wall every 5 average", "'average' is the last word, expected 'yes' or 'no' after it");
  expect("wall every 5 average maybe", "average is 'maybe', expected 'yes' or 'no'");
}

TEST(StlWords, AreReadAndRefused) {
  const auto parse = [](const std::string& text) {
    const std::vector<std::string> words = split(text);
    liggghts_pkg::WordReader reader(words, 0);
    return liggghts_pkg::read_stl(reader);
  };
  EXPECT_EQ(parse("out/wall every 20 chord 1e-4").file, "out/wall");
  EXPECT_EQ(parse("out/wall every 20 chord 1e-4").every, 20);
  EXPECT_EQ(parse("out/wall every 20 chord 1e-4").chord, 1e-4);
  EXPECT_FALSE(parse("out/wall every 20").chord);
  EXPECT_THAT([&] { parse("wall every 5 chord 0"); }, testing::ThrowsMessage<std::invalid_argument>(HasSubstr(
                                                          "stl chord is '0', expected a number above 0")));
  EXPECT_THAT([&] { parse("wall 5"); }, testing::ThrowsMessage<std::invalid_argument>(
                                            HasSubstr("'5' stands where 'every' is expected")));
}

}  // namespace

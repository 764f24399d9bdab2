// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/yaml_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace geometry_io {
namespace {

using namespace nurbs;

using testing::ElementsAre;

YamlMap parsed_map(const std::string& text) { return YamlMap::parse(text, "f.yaml"); }

TEST(YamlMap, ReadsEveryKind) {
  const YamlMap map = parsed_map(
      "word: steel\nwords: [x, y]\nnumber: +2.5e-3\ninteger: 7\nvector: [1, -2, 3.5]\nnumbers: [1, 2]\n"
      "integers: [3, 4]\ntable: [[1, 2], [3]]\nmap: {a: 1}\nlist:\n  - {b: 2}\n  - {b: 3}\n");
  EXPECT_EQ(map.word("word"), "steel");
  EXPECT_EQ(map.word_of("word", {"glass", "steel"}), "steel");
  EXPECT_THAT(map.words("words"), ElementsAre("x", "y"));
  EXPECT_EQ(map.number("number"), 2.5e-3);
  EXPECT_EQ(map.integer("integer", 0, 7), 7);
  EXPECT_EQ(map.vector3("vector"), Vector3(1, -2, 3.5));
  EXPECT_THAT(map.numbers("numbers"), ElementsAre(1, 2));
  EXPECT_THAT(map.integers("integers", 3, 4), ElementsAre(3, 4));
  EXPECT_THAT(map.table("table"), ElementsAre(ElementsAre(1, 2), ElementsAre(3)));
  EXPECT_EQ(map.map("map").integer("a", 0, 9), 1);
  ASSERT_EQ(map.list_of_maps("list").size(), 2u);
  EXPECT_EQ(map.list_of_maps("list")[1].integer("b", 0, 9), 3);
  EXPECT_TRUE(map.has("map") && map.is_list("table") && !map.is_list("word") && !map.has("other"));
  EXPECT_EQ(map.keys().size(), 10u);
  EXPECT_EQ(map.line_of("number"), 3);
  EXPECT_EQ(map.list_of_maps("list")[1].line(), 12);
}

// Ten aliases of ten aliases of ... ten words.
std::string billion_laughs() {
  std::string text = "l0: &l0 [a, a, a, a, a, a, a, a, a, a]\n";
  for (char level = '1'; level <= '9'; ++level) {
    text += std::string("l") + level + ": &l" + level + " [";
    for (int i = 0; i < 10; ++i) text += std::string("*l") + static_cast<char>(level - 1) + ", ";
    text += "]\n";
  }
  return text;
}

TEST(YamlMap, AnAliasIsWhatItsAnchorNames) {
  const YamlMap map = parsed_map("a: &mesh {degree: 2}\nb: *mesh\nc: [&x 1.5, 2, *x]\n");
  EXPECT_EQ(map.map("b").integer("degree", 0, 9), 2);
  EXPECT_THAT(map.numbers("c"), ElementsAre(1.5, 2, 1.5));
}

std::string in_utf16(const std::u16string& text) {  // the high byte first, as its mark says
  std::string bytes = "\xFE\xFF";
  for (const char16_t c : text) bytes += {static_cast<char>(c >> 8), static_cast<char>(c & 0xFF)};
  return bytes;
}

struct BadInput {
  std::string text;
  std::function<void(const YamlMap&)> read;
  std::string message;
};

TEST(YamlMap, SaysWhatWasGivenAndWhatWasExpected) {
  const auto number = [](const YamlMap& m) { m.number("E", positive()); };
  const auto integer = [](const YamlMap& m) { m.integer("n", 1, 6); };
  const auto only = [](const YamlMap& m) { m.allow_only({"density", "E", "n"}); };
  const auto nothing = [](const YamlMap&) {};
  const std::vector<BadInput> table = {
      {"", nothing, "f.yaml:1: file is empty, expected a mapping (key: value)"},
      {"just words", nothing, "f.yaml:1: file is just words, expected a mapping (key: value)"},
      {"- 1\n- 2\n", nothing, "f.yaml:1: file is a list of 2, expected a mapping (key: value)"},
      {"a: 1\n---\nb: 2\n", nothing, "f.yaml:3: 2 documents given, expected one"},
      {",", nothing, "f.yaml:1: broken YAML: text where a key or the end is expected"},
      {"{a: 1},\n", nothing, "f.yaml:1: broken YAML: text where a key or the end is expected"},
      {"a: 1\n...\n, b\n", nothing, "f.yaml:3: broken YAML: text where a key or the end is expected"},
      {"\xEF\xBB\xBF# \xC3\xA9\n,", nothing,
       "f.yaml:2: broken YAML: text where a key or the end is expected"},
      {in_utf16(u"# \u6F22\u5B57\u6F22\u5B57\u6F22\u5B57\u6F22\u5B57\n,"), nothing,
       "f.yaml:2: broken YAML: text where a key or the end is expected"},
      {std::string(1000000, '['), nothing,
       "f.yaml:1: lists or mappings nested too deeply, expected 500 levels at most"},
      {"a: &a [1, *a]\n", nothing, "f.yaml:1: broken YAML: an alias stands inside of what it is an alias of"},
      {"a: *b\n", nothing, "f.yaml:1: broken YAML: the referenced anchor is not defined"},
      {billion_laughs(), nothing, "f.yaml:6: aliases stand for more than 1000000 values, expected fewer"},
      {"a: [1, 2\nb: 3\n", nothing, "f.yaml:2: broken YAML: end of sequence flow not found"},
      {"E: 1\n\ndensty: 2\n", only,
       "f.yaml:3: unknown key 'densty', did you mean 'density'? expected one of: density, E, n"},
      {"E: 1\ncolour: 2\n", only, "f.yaml:2: unknown key 'colour', expected one of: density, E, n"},
      {"E: 1\nn: 1\nE: 2\n", only, "f.yaml:3: E is given twice, expected once"},
      {"E: 1\nn: 1\nE: 2\n", [](const YamlMap& m) { m.keys(); }, "f.yaml:3: E is given twice, expected once"},
      {"[1, 2]: 3\n", only, "f.yaml:1: key is a list of 2, expected a word"},
      {"n: 1\n", number, "f.yaml:1: E is missing"},
      {"n: 1\nE: -1\n", number, "f.yaml:2: E is -1, expected a number > 0"},
      {"E: 0\n", number, "f.yaml:1: E is 0, expected a number > 0"},
      {"E: steel\n", number, "f.yaml:1: E is steel, expected a number > 0"},
      {"E: 1.5 GPa\n", number, "f.yaml:1: E is 1.5 GPa, expected a number > 0"},
      {"E: \"1\\n2\"\n", number, "f.yaml:1: E is 1 2, expected a number > 0"},
      {"E: .nan\n", number, "f.yaml:1: E is .nan, expected a number > 0"},
      {"E: nan\n", number, "f.yaml:1: E is nan, expected a number > 0"},
      {"E: inf\n", number, "f.yaml:1: E is inf, expected a number > 0"},
      {"E: 1e999\n", number, "f.yaml:1: E is 1e999, expected a number > 0"},
      {"E:\n", number, "f.yaml:1: E is empty, expected a value"},
      {"E: [1]\n", number, "f.yaml:1: E is a list of 1, expected a number > 0"},
      {"nu: 0.5\n",
       [](const YamlMap& m) {
         m.number("nu", {-1.0, 0.5});
       },
       "f.yaml:1: nu is 0.5, expected a number > -1 and < 0.5"},
      {"c: -1\n", [](const YamlMap& m) { m.number("c", non_negative()); },
       "f.yaml:1: c is -1, expected a number >= 0"},
      {"n: 7\n", integer, "f.yaml:1: n is 7, expected a whole number from 1 to 6"},
      {"n: 2.5\n", integer, "f.yaml:1: n is 2.5, expected a whole number from 1 to 6"},
      {"n: 99999999999999\n", integer, "f.yaml:1: n is 99999999999999, expected a whole number from 1 to 6"},
      {"v: [1, 2]\n", [](const YamlMap& m) { m.vector3("v"); },
       "f.yaml:1: v is a list of 2, expected 3 numbers"},
      {"v: 1\n", [](const YamlMap& m) { m.vector3("v"); }, "f.yaml:1: v is 1, expected a list of numbers"},
      {"v: [1,\n 2,\n x]\n", [](const YamlMap& m) { m.vector3("v"); },
       "f.yaml:3: v is x, expected a finite number"},
      {"t: [[1],\n 2]\n", [](const YamlMap& m) { m.table("t"); },
       "f.yaml:2: t[1] is 2, expected a list of numbers"},
      {"w: {a: 1}\n", [](const YamlMap& m) { m.word("w"); }, "f.yaml:1: w is a mapping, expected a word"},
      {"w: iron\n",
       [](const YamlMap& m) {
         m.word_of("w", {"glass", "steel"});
       },
       "f.yaml:1: w is iron, expected one of: glass, steel"},
      {"w: Glas\n",
       [](const YamlMap& m) {
         m.word_of("w", {"glass", "steel"});
       },
       "f.yaml:1: w is Glas, did you mean 'glass'? expected one of: glass, steel"},
      {"a: 1\n",
       [](const YamlMap& m) {
         m.word_of("w", {"glass", "steel"});
       },
       "f.yaml:1: w is missing, expected one of: glass, steel"},
      {"w: iron\n", [](const YamlMap& m) { m.words("w"); },
       "f.yaml:1: w is iron, expected a list of words: [iron]"},
      {"a: 3\n", [](const YamlMap& m) { m.map("a", "{b: 3}"); },
       "f.yaml:1: a is 3, expected a mapping: {b: 3}"},
      {"a: {c: 1}\n\tb: 2\n", nothing,
       "f.yaml:2: broken YAML: end of map not found; the line begins with a tab, expected spaces"},
      {"# don't\na: 3  # \"\nb: {c: \"it's,\n  d: 3}\n", nothing,
       "f.yaml:3: broken YAML: a quoted text begins here and does not end"},
      {"a: it's\nb: \"\\\"\"\nc: 'x''\n", nothing,
       "f.yaml:3: broken YAML: a quoted text begins here and does not end"},
      {"\xEF\xBB\xBF"
       "a: 1\nb: &f !!str 'x\n",
       nothing, "f.yaml:2: broken YAML: a quoted text begins here and does not end"},
      {"a: it's\nb: 'it''s'\nc: [\n", nothing, "f.yaml:4: broken YAML: end of sequence flow not found"},
      {"a: &a {b: 1}\nc:\n  <<: *a\n", [](const YamlMap& m) { m.map("c"); },
       "f.yaml:3: '<<' merges mappings in YAML 1.1 alone, expected the keys themselves, or an alias of a "
       "whole "
       "mapping"},
      {"a:\n  b: 3\n", [](const YamlMap& m) { m.map("a").map("b"); },
       "f.yaml:2: a.b is 3, expected a mapping (key: value)"},
      {"a:\n  b: 3\n", [](const YamlMap& m) { m.map("a").allow_only({"c"}); },
       "f.yaml:2: unknown key 'b' in a, expected one of: c"},
      {"l:\n  - {a: 1}\n  - {a: x}\n", [](const YamlMap& m) { m.list_of_maps("l")[1].number("a"); },
       "f.yaml:3: l[1].a is x, expected a finite number"},
  };
  for (const BadInput& bad : table) {
    SCOPED_TRACE(bad.text);
    try {
      bad.read(parsed_map(bad.text));
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), bad.message);
    }
  }
}

TEST(YamlMap, NearestWord) {
  const std::vector<std::string> words{"youngs_modulus", "poissons_ratio", "density", "nu"};
  EXPECT_EQ(nearest_word("young_modulus", words), "youngs_modulus");
  EXPECT_EQ(nearest_word("poisson_ratio", words), "poissons_ratio");
  EXPECT_EQ(nearest_word("dnesity", words), "density");
  EXPECT_EQ(nearest_word("temperature", words), "");
  EXPECT_EQ(nearest_word("E", words), "");
  EXPECT_EQ(nearest_word("NU", words), "nu");
}

}  // namespace
}  // namespace geometry_io

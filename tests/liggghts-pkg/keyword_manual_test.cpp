// SPDX-License-Identifier: GPL-2.0-or-later
// The manual shows every word that a deck may hold, with its values, and none that it may not.
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include "contact_laws.h"
#include "geometry_io/shape_reader.h"
#include "model_words.h"
#include "motion_words.h"
#include "output_words.h"
#include "stock_words.h"
#include "wall_nurbs_options.h"

namespace {

using testing::Contains;

std::string page(const std::string& name) {
  std::ifstream file(std::string(MANUAL_FOLDER) + "/" + name);
  EXPECT_TRUE(file) << name;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// All that is set as code: between backticks, or in blocks.
std::string code(const std::string& page) {
  static const std::regex kCode("```[^`]*```|`[^`]+`");
  std::string all;
  for (std::sregex_iterator at(page.begin(), page.end(), kCode), end; at != end; ++at)
    all += at->str() + "\n";
  return all;
}

/// Whether `syntax` stands there as whole words.
bool shows(const std::string& code, const std::string& syntax) {
  const auto in_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '/';
  };
  for (auto at = code.find(syntax); at != std::string::npos; at = code.find(syntax, at + 1))
    if ((at == 0 || !in_word(code[at - 1])) && !in_word(code[at + syntax.size()])) return true;
  return false;
}

std::string first_word(const std::string& line) { return line.substr(0, line.find(' ')); }

std::vector<std::string> first_words(std::vector<std::string> lines) {
  std::transform(lines.begin(), lines.end(), lines.begin(), first_word);
  return lines;
}

/// What the first group of the expression holds, each time it is met.
std::vector<std::string> found(const std::string& text, const std::string& expression) {
  const std::regex pattern(expression);
  std::vector<std::string> all;
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at)
    all.push_back(at->str(1));
  return all;
}

TEST(Manual, ShowsEveryWord) {
  const std::string shown = code(page("fix_wall_nurbs.md") + page("moving_wall.md"));
  for (const auto& lines : {liggghts_pkg::model_syntax(), liggghts_pkg::wall_nurbs_syntax(),
                            liggghts_pkg::output_fields(), liggghts_pkg::motion_syntax()})
    for (const std::string& syntax : lines) EXPECT_TRUE(shows(shown, syntax)) << syntax;
}

TEST(Manual, ShowsEveryContactLaw) {
  const std::string shown = code(page("fix_wall_nurbs.md"));
  liggghts_pkg::for_each_law([&](auto law) {
    EXPECT_TRUE(shows(shown, law.word)) << law.word;
    for (const liggghts_pkg::LawProperty& property : law.properties)
      EXPECT_TRUE(shows(shown, std::string("property/global ") + property.name)) << property.name;
  });
}

// What a deck is told of words of stock walls has a line there, and is never told of a word of ours.
TEST(Manual, ShowsWordsOfStockWalls) {
  const std::string shown = code(page("mesh_walls.md"));
  for (const liggghts_pkg::StockWord& row : liggghts_pkg::kStockWords) {
    EXPECT_TRUE(shows(shown, row.word)) << row.word;
    EXPECT_THAT(first_words(liggghts_pkg::wall_nurbs_syntax()), testing::Not(Contains(row.word)));
  }
}

TEST(Manual, ShowsNoOtherWords) {
  const std::string text = page("fix_wall_nurbs.md");
  const std::vector<std::string> keywords = first_words(liggghts_pkg::wall_nurbs_syntax());
  const std::vector<std::string> listed = found(text, "\n  \\* `([a-z_]+) ");
  EXPECT_GE(listed.size(), 10u);
  for (const std::string& word : listed) EXPECT_THAT(keywords, Contains(word));

  const std::string moving = page("moving_wall.md");
  const std::vector<std::string> words = first_words(liggghts_pkg::motion_syntax());
  const std::vector<std::string> verbs = found(moving, "\nmotion ([a-z/]+)"),
                                 changes = found(moving, "\nfix_modify ID (\\S+)");
  EXPECT_EQ(verbs.size(), 8u);
  EXPECT_EQ(changes.size(), 7u);
  for (const auto& shown : {verbs, changes})
    for (const std::string& word : shown) EXPECT_THAT(words, Contains(word));
}

// A shape is a row of the manual's table; keys that all round shapes have may stand below it.
TEST(Manual, ShowsEveryShapeWithItsKeys) {
  const std::string text = page("fix_wall_nurbs.md");
  const std::string shapes = text.substr(text.find("**Shapes**"));
  for (const geometry_io::ShapeWords& shape : geometry_io::shape_words()) {
    const auto row = found(shapes, "\n\\| `" + shape.word + "`[^|]*\\|([^|]*)\\|");
    ASSERT_EQ(row.size(), 1u) << shape.word;
    for (const std::string& key : found(row[0], "`([a-z_]+)")) EXPECT_THAT(shape.keys, Contains(key));
    for (const std::string& key : shape.keys) {
      const bool is_of_all = key == "elements" || key == "degree" || key == "reference";
      EXPECT_TRUE(shows(code(is_of_all ? shapes : row[0]), key)) << shape.word << ": " << key;
    }
  }
}

}  // namespace

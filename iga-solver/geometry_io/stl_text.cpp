// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/stl_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "geometry_io/input_error.h"
#include "geometry_io/parse_number.h"

namespace geometry_io {
namespace {

using std::string_view;

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool ends_line(char c) { return c == '\n' || c == '\r'; }

// `lower` is in lower case.
bool is_word(string_view word, string_view lower) {
  if (word.size() != lower.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char c = word[i] >= 'A' && word[i] <= 'Z' ? static_cast<char>(word[i] - 'A' + 'a') : word[i];
    if (c != lower[i]) return false;
  }
  return true;
}

class TextReader {
 public:
  TextReader(const std::string& text, const std::string& file)
      : at_(text.data()), end_(text.data() + text.size()), file_(file) {
    if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) at_ += 3;
    constexpr std::size_t kShortestTriangle = 100;  // some more than most files need
    soup_.corners.reserve(9 * (text.size() / kShortestTriangle));
  }

  TriangleSoup read() {
    for (string_view word = next_word(); !word.empty(); word = next_word()) {
      if (!is_word(word, "solid")) fail(word, "'solid'");
      read_solid();
    }
    return std::move(soup_);
  }

 private:
  void read_solid() {
    solid_line_ = line_;
    const std::size_t first = soup_.place.size();
    soup_.blocks.push_back({name(false), static_cast<int>(first)});
    for (;;) {
      const string_view word = next_word();
      if (is_word(word, "endsolid") || (word.empty() && soup_.place.size() > first)) break;  // some forget it
      if (!is_word(word, "facet")) fail(word, "'facet' or 'endsolid'");
      read_facet();
    }
    name(true);
    solid_line_ = 0;
  }

  void read_facet() {
    soup_.place.push_back(line_);
    expect("normal");
    string_view word = next_word();
    for (int k = 0; k < 3 && !is_word(word, "outer"); ++k) word = next_word();  // of any kind: "nan", too
    if (!is_word(word, "outer")) fail(word, "'outer loop'");
    expect("loop");
    for (int corner = 0; corner < 3; ++corner) {
      expect("vertex");
      for (int d = 0; d < 3; ++d) soup_.corners.push_back(number());
    }
    expect("endloop");
    expect("endfacet");
  }

  double number() {
    const string_view word = next_word();
    double x = 0.0;
    if (!parse_number(word, x)) fail(word, "a number");
    if (!(std::abs(x) <= std::numeric_limits<float>::max()))
      fail(word, "a number that single precision can hold");
    return x;
  }

  void expect(string_view lower) {
    const string_view word = next_word();
    if (!is_word(word, lower)) fail(word, fmt::format("'{}'", lower));
  }

  // Empty at the end of the file.
  string_view next_word() {
    for (; at_ != end_ && is_blank(*at_); ++at_) count_line();
    const char* begin = at_;
    while (at_ != end_ && !is_blank(*at_)) ++at_;
    return {begin, static_cast<std::size_t>(at_ - begin)};
  }

  // Lines end with LF, CR LF, or CR.
  void count_line() { line_ += *at_ == '\n' || (*at_ == '\r' && (at_ + 1 == end_ || at_[1] != '\n')); }

  // The line's end, or where its first facet begins: some files are one line.  `of_end`: or the solid that
  // this facet is of.
  const char* end_of_name(bool of_end) const {
    const char* const line_end = std::find_if(at_, end_, ends_line);
    string_view before;
    const char* solid = nullptr;
    for (const char* at = at_; at != line_end;) {
      at = std::find_if_not(at, line_end, is_blank);
      const char* const begin = at;
      at = std::find_if(at, line_end, is_blank);
      const string_view word(begin, static_cast<std::size_t>(at - begin));
      if (is_word(word, "normal") && is_word(before, "facet")) return of_end && solid ? solid : before.data();
      if (is_word(word, "solid")) solid = begin;
      before = word;
    }
    return line_end;
  }

  // What follows 'solid' and 'endsolid', without what follows a ';' or '#'; blanks inside as one.
  std::string name(bool of_end) {
    std::string name;
    bool comment = false;
    for (const char* const end = end_of_name(of_end); at_ != end; ++at_) {
      comment |= *at_ == ';' || *at_ == '#';
      if (comment) continue;
      if (!is_blank(*at_))
        name += *at_;
      else if (!name.empty() && name.back() != ' ')
        name += ' ';
    }
    if (!name.empty() && name.back() == ' ') name.pop_back();
    return name;
  }

  [[noreturn]] void fail(string_view word, const std::string& expected) const {
    const std::string& name = soup_.blocks.empty() ? file_ : soup_.blocks.back().name;
    if (word.empty() && solid_line_ > 0)
      fail_at_line(file_, line_,
                   fmt::format("the file ends within the solid '{}' of line {}, expected {}: is it whole?",
                               shown(name), solid_line_, expected));
    const char* const cut = solid_line_ > 0 && at_ == end_ ? ", which ends here: is it whole?" : "";
    fail_at_line(
        file_, line_,
        fmt::format("'{}', expected {} in an ASCII STL file{}", shown(std::string(word)), expected, cut));
  }

  const char *at_, *end_;
  const std::string& file_;
  int line_ = 1, solid_line_ = 0;  // 0: between solids
  TriangleSoup soup_;
};

}  // namespace

TriangleSoup read_stl_text(const std::string& text, const std::string& file) {
  return TextReader(text, file).read();
}

}  // namespace geometry_io

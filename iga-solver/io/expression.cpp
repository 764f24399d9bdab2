// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/expression.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "geometry_io/parse_number.h"
#include "nurbs/usable_number.h"
#include "structure/conditions/grid_table.h"
#include "structure/time/divergence.h"

namespace io {

using geometry_io::YamlMap;

struct Expression::Parser {
  mu::Parser parser;
  std::array<double, 4> xyzt{};
};

namespace {

constexpr const char* kVariables[] = {"x", "y", "z", "t"};

/// `a = b` would set a variable.
bool assigns(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '=') {
      const bool compares = (i > 0 && std::string("=<>!").find(text[i - 1]) != std::string::npos) ||
                            (i + 1 < text.size() && text[i + 1] == '=');
      if (!compares) return true;
    }
  return false;
}

std::string expected(const std::vector<std::string>& variables) {
  return fmt::format("expected a number or an expression of {}", fmt::join(variables, ", "));
}

}  // namespace

Expression::Expression(const std::string& text, const std::vector<std::string>& variables)
    : parser_(std::make_shared<Parser>()) {
  const auto fail = [&](const std::string& why) {
    throw std::invalid_argument(
        fmt::format("is '{}': {}; {}", geometry_io::shown(text), why, expected(variables)));
  };
  if (assigns(text)) fail("it assigns");
  try {
    mu::Parser& parser = parser_->parser;
    parser.DefineConst("pi", std::acos(-1.0));
    for (int i = 0; i < 4; ++i)
      if (std::find(variables.begin(), variables.end(), kVariables[i]) != variables.end())
        parser.DefineVar(kVariables[i], &parser_->xyzt[i]);
    parser.SetExpr(text);
    int results = 0;
    parser.Eval(results);
    if (results != 1) fail(fmt::format("it has {} values", results));
  } catch (const mu::Parser::exception_type& error) {
    fail(error.GetMsg());
  }
}

double Expression::operator()(const nurbs::Vector3& X, double t) const {
  parser_->xyzt = {X[0], X[1], X[2], t};
  return parser_->parser.Eval();
}

bool Expression::uses(const std::string& variable) const {
  return parser_->parser.GetUsedVar().count(variable) > 0;
}

namespace {

/// A number is an expression, too, of nothing.
Expression read_expression(const YamlMap& map, const std::string& key, const std::string& text,
                           const std::vector<std::string>& variables) {
  double number = 0.0;
  if (geometry_io::parse_number(text, number) && !nurbs::is_usable(number))
    map.fail(key, fmt::format("{} has {}, expected a number of at most {} in size", key, text,
                              nurbs::kLargestNumber));
  try {
    return {text, variables};
  } catch (const std::invalid_argument& error) {
    map.fail(key, fmt::format("{} {}", key, error.what()));
  }
}

FieldKey field_of(const YamlMap& map, const std::string& name, const std::vector<Expression>& parts) {
  FieldKey key;
  key.place = fmt::format("{}:{}", map.file(), map.line_of(name));
  for (const Expression& part : parts) {
    key.is_uniform = key.is_uniform && !part.uses("x") && !part.uses("y") && !part.uses("z");
    key.changes = key.changes || part.uses("t");
  }
  key.field = [parts](const nurbs::Vector3& X, double t) {
    nurbs::Vector3 value = nurbs::Vector3::Zero();
    for (std::size_t i = 0; i < parts.size(); ++i) value[i] = parts[i](X, t);
    return value;
  };
  return key;
}

/// `{x: [...], t: [...], table: [[...], ...]}` with some of the variables and rows of `components` numbers.
FieldKey read_grid_table(const YamlMap& entry, const std::string& key,
                         const std::vector<std::string>& variables, std::size_t components) {
  const YamlMap map = entry.map(key);
  std::vector<std::string> allowed = variables;
  allowed.emplace_back("table");
  map.allow_only(allowed);
  structure::GridAxes axes;
  for (int d = 0; d < 4; ++d)
    if (map.has(kVariables[d])) axes[d] = map.numbers(kVariables[d]);
  std::vector<nurbs::Vector3> rows;
  for (const std::vector<double>& row : map.table("table")) {
    if (row.size() != components)
      map.fail("table", fmt::format("table has a row of {} numbers, expected {}", row.size(), components));
    rows.emplace_back(nurbs::Vector3::Zero()).head(Eigen::Index(components)) =
        Eigen::VectorXd::Map(row.data(), Eigen::Index(components));
  }
  FieldKey field;
  field.place = fmt::format("{}:{}", entry.file(), entry.line_of(key));
  field.is_uniform = axes[0].empty() && axes[1].empty() && axes[2].empty();
  field.changes = !axes[3].empty();
  try {
    field.field = structure::grid_table(std::move(axes), std::move(rows));
  } catch (const std::invalid_argument& problem) {
    map.fail("table", fmt::format("table: {}", problem.what()));
  }
  return field;
}

}  // namespace

structure::TimeFunction read_time_expression(const YamlMap& map, const std::string& key) {
  const Expression expression = read_expression(map, key, map.word(key), {"t"});
  const std::string place = fmt::format("{}:{}", map.file(), map.line_of(key));
  return [=](double t) {
    const double factor = expression(nurbs::Vector3::Zero(), t);
    if (!std::isfinite(factor))  // on all ranks alike
      throw structure::Diverged(fmt::format("the factor '{}' of {} is {} at time {:.6g}, expected a number",
                                            key, place, factor, t));
    return factor;
  };
}

FieldKey read_field(const YamlMap& map, const std::string& key, const std::vector<std::string>& variables) {
  if (map.is_map(key)) return read_grid_table(map, key, variables, 3);
  std::vector<Expression> parts;
  if (!map.is_list(key))
    map.fail(key, fmt::format("{} is not a list, expected 3 numbers or expressions, [x, y, z]", key));
  for (const std::string& text : map.words(key)) parts.push_back(read_expression(map, key, text, variables));
  if (parts.size() != 3)
    map.fail(key, fmt::format("{} is a list of {}, expected 3 numbers or expressions", key, parts.size()));
  return field_of(map, key, parts);
}

FieldKey read_scalar_field(const YamlMap& map, const std::string& key,
                           const std::vector<std::string>& variables) {
  if (map.is_map(key)) return read_grid_table(map, key, variables, 1);
  return field_of(map, key, {read_expression(map, key, map.word(key), variables)});
}

}  // namespace io

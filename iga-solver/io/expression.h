// SPDX-License-Identifier: GPL-2.0-or-later
// Expressions in model files: of the place in the undeformed body x, y, z [length] and the time t [time],
// with pi, + - * / ^, ?:, comparisons, sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, exp, ln,
// log10, sqrt, abs, sign, min, max (muParser's).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "geometry_io/yaml_map.h"
#include "structure/conditions/field.h"
#include "structure/conditions/time_function.h"

namespace io {

class Expression {
 public:
  /// Of these variables, some of x, y, z, t.  Throws std::invalid_argument with what is wrong and where.
  Expression(const std::string& text, const std::vector<std::string>& variables);
  double operator()(const nurbs::Vector3& X, double t) const;
  bool uses(const std::string& variable) const;

 private:
  struct Parser;
  std::shared_ptr<Parser> parser_;  // copies share it: one thread
};

/// A number or an expression of t; where that is not finite the function throws structure::Diverged.
structure::TimeFunction read_time_expression(const geometry_io::YamlMap& map, const std::string& key);

/// A value that the model file gives by numbers, expressions or a table.
struct FieldKey {
  structure::Field field;
  bool is_uniform = true, changes = false;  ///< the same everywhere; not the same at all times
  std::string place = {};                   ///< "plate.yaml:12", for messages
};
/// Three numbers or expressions of `variables`, or a table on a grid of them, `{x: [0, 1], t: [0, 1e-3],
/// table: [[...], ...]}`.  Throws geometry_io::InputError.
FieldKey read_field(const geometry_io::YamlMap& map, const std::string& key,
                    const std::vector<std::string>& variables);
/// One of them; the field has it in x.
FieldKey read_scalar_field(const geometry_io::YamlMap& map, const std::string& key,
                           const std::vector<std::string>& variables);

}  // namespace io

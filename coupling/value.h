// SPDX-License-Identifier: GPL-2.0-or-later
// A number that may change from step to step.
#pragma once

#include <functional>

namespace coupling {

/// A constant, or something to evaluate anew each time (a variable of the deck).  An evaluation must give the
/// same number on every rank and may be collective.
class Value {
 public:
  Value(double constant = 0.0) : constant_(constant) {}
  Value(std::function<double()> variable) : variable_(std::move(variable)) {}

  bool varies() const { return static_cast<bool>(variable_); }
  double operator()() const { return variable_ ? variable_() : constant_; }

 private:
  double constant_ = 0.0;
  std::function<double()> variable_;
};

}  // namespace coupling

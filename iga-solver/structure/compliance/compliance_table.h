// SPDX-License-Identifier: GPL-2.0-or-later
// Local compliances on one element of a body's skin, as polynomials.  There c is one of degree 2 p in each
// direction, but for what the half-space's data add, which vary little; so (2 p + 1)^2 values hold it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "nurbs/patch.h"
#include "structure/compliance/border_strips.h"
#include "structure/compliance/table_kernel.h"
#include "structure/compliance/table_memory.h"

namespace structure {

class ComplianceTable : public InTableMemory<ComplianceTable> {
 public:
  /// Components of the tensor in the frame (t_1, t_2, n): t_1 along the surface's first direction, n out of
  /// the body, t_2 = n x t_1.
  enum Component { normal, first, second, first_second, first_normal, second_normal, kComponents };
  static constexpr int kPolynomials = kComponents;
  using Strips = BorderStrips<kPolynomials>;
  static constexpr int kTogether = first_second + 1;  ///< those that a contact with friction asks for

  /// c [length/force], and its changes with the parameters [length/force/parameter].
  struct Value {
    double c;
    std::array<double, 2> change;
  };

  /// From values at table_points(): [component][point]; `taken`: what links take off along the normal
  /// (cross_compliance.h), which is no part of the values, or nothing.
  ComplianceTable(const std::array<int, 2>& counts, const std::vector<std::vector<double>>& values,
                  const std::vector<double>& taken = {});
  /// Where it goes on as those beside it.
  ComplianceTable(const ComplianceTable& other, const Strips& strips) : ComplianceTable(other) {
    strips_ = strips;
  }
  const double* powers() const { return powers_.data(); }  ///< [component][of t][of s]
  /// Components in another frame, whose t_1 is c t_1 + s t_2 of this one, into those in this one.
  static void turn(double* components, double c, double s);
  static void turn_together(double* components, double c, double s);  ///< of the first kTogether

  /// On the element [low, high] of the parameters.
  Value at(Component component, const nurbs::Parameter<2>& low, const nurbs::Parameter<2>& high,
           const nurbs::Parameter<2>& xi) const;
  /// f(component, value) for the first kTogether, to the last bit as one by one.
  template <class Function>
  void together(const nurbs::Parameter<2>& low, const nurbs::Parameter<2>& high,
                const nurbs::Parameter<2>& xi, Function f) const {
    static_assert(kTogether == FourPolynomials::kCount);
    const OwnParameter s(low[0], high[0], xi[0]), t(low[1], high[1], xi[1]);
    FourPolynomials at;
    kernel_(together_.data(), counts_[0], counts_[1], s.value, t.value, at);
    if (strips_.reach(s.value, t.value))
      strips_.add(s.value, t.value, 0, kTogether, at.value, at.by_s, at.by_t);
    for (int k = 0; k < kTogether; ++k)
      f(k, Value{at.value[k], {at.by_s[k] * s.change, at.by_t[k] * t.change}});
  }
  /// Has what together() and taken() read there of a quadratic one come from memory, and the beginning of
  /// others, while something else is done: nothing is read here.
  [[gnu::always_inline]] void prefetch(const nurbs::Parameter<2>& low, const nurbs::Parameter<2>& high,
                                       const nurbs::Parameter<2>& xi) const {
    constexpr std::ptrdiff_t kLine = 64, kQuadratic = 5 * 5;
    const char* const end = reinterpret_cast<const char*>(together_.data() + kTogether * kQuadratic);
    for (const char* line = reinterpret_cast<const char*>(this); line < end; line += kLine)
      __builtin_prefetch(line);
    strips_.prefetch(OwnParameter(low[0], high[0], xi[0]).value, OwnParameter(low[1], high[1], xi[1]).value);
  }
  /// Largest value at its points [length/force].
  double largest_normal() const { return largest_normal_; }
  /// What links take off, to seven digits [length/force].
  double taken(const nurbs::Parameter<2>& low, const nurbs::Parameter<2>& high,
               const nurbs::Parameter<2>& xi) const {
    const OwnParameter s(low[0], high[0], xi[0]), t(low[1], high[1], xi[1]);
    return counts_[0] == 5 ? taken<5>(s.value, t.value) : taken<7>(s.value, t.value);
  }

 private:
  // An element's own parameter, from -1 to 1, and its change with that of the patch.
  struct OwnParameter {
    OwnParameter(double low, double high, double xi)
        : change(2.0 / (high - low)), value(change * (xi - low) - 1.0) {}
    double change, value;
  };
  static constexpr int kMost = 7 * 7;  // values of a component: of degree 3

  template <int count>
  double taken(double s, double t) const {
    std::array<double, count> row{};
    for (int j = counts_[1] - 1; j >= 0; --j)
      for (int i = 0; i < count; ++i) row[i] = row[i] * t + taken_[j * count + i];
    double value = 0.0;
    for (int i = count - 1; i >= 0; --i) value = value * s + row[i];
    return value;
  }

  // In one piece, as it comes from memory.
  TableKernel kernel_;
  std::array<int, 2> counts_;
  double largest_normal_;
  std::array<float, kMost> taken_{};                // [of t][of s]; few, as they come for each contact
  std::array<double, kTogether * kMost> together_;  // [of t][of s][component] in s, t from -1 to 1
  Strips strips_;
  std::array<double, kComponents * kMost> powers_;  // [component][of t][of s], the same
};

/// Chebyshev's points with both ends of [-1, 1], rising.
std::vector<double> lobatto_points(int count);

/// How many values a table has in each direction: the product of so many lobatto_points() is its points.
std::array<int, 2> table_counts(const nurbs::Space<2>& space);
/// On the element, the first direction fastest.
std::vector<nurbs::Parameter<2>> table_points(const nurbs::Space<2>& space, int element);

}  // namespace structure

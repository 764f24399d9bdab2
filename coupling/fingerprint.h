// SPDX-License-Identifier: GPL-2.0-or-later
// What a saved state belongs to, so that it is not loaded into something else: geometry, mesh, material,
// supports; not loads, output or the names of files.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "brep/surface.h"
#include "nurbs/patch.h"

namespace coupling {

struct FingerprintPart {
  std::string name;             ///< "material"
  std::string text;             ///< what it is, for messages: "linear_elastic, E = 5e+09, ..."
  std::vector<double> numbers;  ///< what must agree, within kFingerprintTolerance of each
};
using Fingerprint = std::vector<FingerprintPart>;

/// Relative: more than compilers and mathematical libraries differ by.
constexpr double kFingerprintTolerance = 1e-12;

/// One number for many: sum of 2 |x_i| + c_i x_i with 1/2 <= c_i < 1, each term of which is positive, so a
/// change of any x_i shows in proportion.
double checksum(const std::vector<double>& values);
/// What x_i adds to it: terms may be added in any order, by any rank.
double checksum_term(std::size_t i, double x);

/// Of control points [length], what is compared.
struct ControlPointDigest {
  std::size_t numbers;          ///< 3 per point
  double checksum;              ///< of x, y, z of the first, then of the second
  nurbs::Vector3 lower, upper;  ///< corners of the box around them
};
ControlPointDigest digest(const nurbs::NodalVectors& control_points);

/// Part "geometry" of patches (dimension 2 or 3) that are given as spaces, with all their control points.
template <int Dim>
FingerprintPart geometry_part(const std::vector<nurbs::Space<Dim>>& patches,
                              const ControlPointDigest& control_points);

/// Of a wall of faces.
FingerprintPart geometry_part(const brep::Surface& faces);

/// A part that is one word, which must agree.
FingerprintPart word_part(const std::string& name, const std::string& word);

/// What differs, for a message: "material: ... then, ... now; supports: ..."; empty if all agrees.
std::string difference(const Fingerprint& then, const Fingerprint& now);

/// As numbers, for restart files, and back.  Throws std::invalid_argument if the numbers are damaged.
std::vector<double> to_numbers(const Fingerprint& fingerprint);
Fingerprint fingerprint_from(const std::vector<double>& numbers);

/// Throws std::invalid_argument: a restart file holds what no wall wrote.
[[noreturn]] void fail_as_damaged();
/// A size, or another count, that a restart file holds; damaged unless it is whole, from 0 to `most`.
std::size_t saved_size(double number, std::size_t most);

}  // namespace coupling

// SPDX-License-Identifier: GPL-2.0-or-later
// What a deck says of a solid of ours, beside its model file.
#pragma once

#include <optional>
#include <string>

namespace coupling {

constexpr int kMostModes = 1000;

struct SolidOptions {
  /// File of the state that it starts from, in place of the model file's own if that names one; empty: none.
  std::string state = {};
  /// A modal body of so many modes (modal_structure.h); nothing: all degrees of freedom.
  std::optional<int> modes = {};
  /// Whether contacts are corrected by what its mesh gives way under them (mesh_compliance.h); nothing: where
  /// that is known.
  std::optional<bool> corrects_contacts = {};
};

}  // namespace coupling

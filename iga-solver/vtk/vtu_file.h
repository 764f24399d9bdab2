// SPDX-License-Identifier: GPL-2.0-or-later
// Files for ParaView: .vtu (one state) and .pvd (a time series of them).  Every file is complete at any
// moment: it is written beside its place and then moved there.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "vtk/bezier_cells.h"

namespace vtk {

/// Writes an unstructured grid; all arrays are base64 in double precision.  Throws std::runtime_error that
/// names the file if it cannot be written, std::invalid_argument as bezier_cells.
template <int Dim>
void write_vtu(const std::string& path, const std::vector<PatchFields<Dim>>& patches);

/// STEM.pvd and STEM_<step>.vtu.
class Series {
 public:
  explicit Series(std::string stem) : stem_(std::move(stem)) {}

  /// Goes on with the STEM.pvd of an earlier run: its states up to `step` stay in the series.  No such file:
  /// an empty series.  Throws std::runtime_error if the file is no series.
  void resume(long step);
  /// Throws as write_vtu.
  template <int Dim>
  void write(long step, double time, const std::vector<PatchFields<Dim>>& patches);
  bool empty() const { return entries_.empty(); }
  std::string path() const { return stem_ + ".pvd"; }

 private:
  void write_index() const;

  std::string stem_;
  std::vector<std::pair<double, std::string>> entries_;  // time, file relative to the .pvd
};

}  // namespace vtk

// SPDX-License-Identifier: GPL-2.0-or-later
// Files for ParaView: .vtu (one state) and .pvd (a time series of them).  Every file is complete at any
// moment: it is written beside its place and then moved there.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vtk/triangle_cells.h"

namespace vtk {

/// What a file says of itself, as field data.
struct About {
  double time = 0.0;       ///< TimeValue
  std::string units = {};  ///< UNITS, in words; empty: not said
};

/// Writes an unstructured grid; all arrays are base64 in double precision, a field's unit is VTK's key
/// UNITS_LABEL.  Throws std::runtime_error that names the file if it cannot be written, std::invalid_argument
/// as bezier_cells and triangle_cells.
template <int Dim>
void write_vtu(const std::string& path, const std::vector<PatchFields<Dim>>& patches,
               const About& about = {});
void write_vtu(const std::string& path, const TriangleFields& triangles, const About& about = {});

/// STEM.pvd and STEM_<step>.vtu.
class Series {
 public:
  explicit Series(std::string stem, std::string units = {})
      : stem_(std::move(stem)), units_(std::move(units)) {}

  /// Goes on with the STEM.pvd of an earlier run: its states up to `step` stay in the series.  No such file:
  /// an empty series.  Throws std::runtime_error if the file is no series.
  void resume(long step);
  /// The same with the states up to `time`, which are counted 0, 1, 2, ...: the time of the last.
  std::optional<double> resume_at(double time);
  /// `fields` and what it throws are those of write_vtu.
  template <class Fields>
  void write(long step, double time, const Fields& fields);
  bool empty() const { return entries_.empty(); }
  long count() const { return static_cast<long>(entries_.size()); }
  std::string path() const { return stem_ + ".pvd"; }

 private:
  void write_index() const;

  using Entry = std::pair<double, std::string>;  // time, file relative to the .pvd
  std::vector<Entry> entries_of_file() const;

  std::string stem_, units_;
  std::vector<Entry> entries_;
};

}  // namespace vtk

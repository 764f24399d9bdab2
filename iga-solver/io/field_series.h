// SPDX-License-Identifier: GPL-2.0-or-later
// Fields of a solid as time series for ParaView: NAME_PLACE.pvd and NAME_PLACE_<n>.vtu for each place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/model_file.h"
#include "io/solid_fields.h"
#include "vtk/vtu_file.h"

namespace io {

class FieldSeries {
 public:
  /// `model.output->fields` is there, and the control points, too.  Writes nothing yet.
  explicit FieldSeries(const ModelFile& model);

  /// Goes on with the files of an earlier run, from `time`: later states are dropped, and come anew.  The
  /// time of the last that is left.  Throws std::runtime_error if a file of the name is no series.
  std::optional<double> resume(double time);
  /// Throws std::runtime_error that names the file if it cannot be written.
  void write(const SolidState& state);

 private:
  struct Place {
    std::optional<std::vector<structure::SkinPiece>> faces;  // nothing: the volume
    vtk::Series series;
  };
  SolidState of_patch(int patch, const SolidState& body) const;

  structure::NodeNumbering nodes_;
  std::vector<SolidFields> fields_;       // of each patch
  std::vector<std::size_t> elements_{0};  // of the patches before, and of all
  std::vector<Place> places_;
};

}  // namespace io

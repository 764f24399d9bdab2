// SPDX-License-Identifier: GPL-2.0-or-later
// Frequencies of free vibrations as a file (HDF5): one row per mode.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry_io/geometry_file.h"
#include "io/output_keys.h"
#include "structure/analysis/modes.h"

namespace io {

/// Writes `<output.file>.h5`: `mode`, `frequency`, `angular_frequency` and `effective_mass` [rows][3], the
/// mass that moves with the mode where all supports shake along x, y, z: (sum of m_A phi_A)^2.  Throws
/// std::runtime_error, naming the file, if it cannot be written.
void write_frequencies(const HistoryOutput& output, geometry_io::Units units,
                       const std::vector<structure::Mode>& modes, const Eigen::VectorXd& nodal_mass);

}  // namespace io

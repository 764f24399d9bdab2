// SPDX-License-Identifier: GPL-2.0-or-later
// nurbs-read-hdf5: an HDF5 file's contents.  Others start it to be safe from what HDF5 does with a damaged
// file (reader_process.h); nobody else needs it.
#include "geometry_io/hdf5_contents.h"
#include "geometry_io/reader_main.h"

int main() {
  return geometry_io::answer_with(10, 10000000, [](const std::string& bytes) {
    return geometry_io::encoded(geometry_io::unpack_hdf5(bytes));
  });
}

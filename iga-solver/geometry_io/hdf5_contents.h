// SPDX-License-Identifier: GPL-2.0-or-later
// What an HDF5 file holds, as plain values.  HDF5's library can crash on a damaged file, so files of others
// are read by a process of their own (reader_process.h), which hands this over as bytes; the schema is read
// from here, and never from HDF5 itself.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace geometry_io {

/// An attribute or a data set.
struct Hdf5Value {
  enum class Kind : std::uint8_t { integers, numbers, texts, other };
  Kind kind = Kind::other;
  std::vector<std::uint64_t> shape;  ///< empty: one value; the last index is the fastest
  std::vector<double> numbers;       ///< also integers
  std::vector<std::string> texts;
  std::string problem;  ///< why there are no values ("cannot be read"); else empty
};

struct Hdf5Object {
  bool is_group = true;
  Hdf5Value values;  ///< of a data set
  std::map<std::string, Hdf5Value> attributes;
};

/// By path: "/", "/patches", "/patches/0", ...
using Hdf5Contents = std::map<std::string, Hdf5Object>;

/// HDF5's library, in this process.  Reads what may belong to the schema: the attributes of "/", and all
/// under /patches, /surfaces, the groups of a CAD model (cad_hdf5.h) and /state (io/state_file.h).  No value
/// takes more memory than its bytes in the file can have been packed from. Throws std::runtime_error.
Hdf5Contents unpack_hdf5(const std::string& bytes);

/// As bytes of this program, on this machine; and back, from whatever bytes.  Throws std::runtime_error.
std::string encoded(const Hdf5Contents& contents);
Hdf5Contents decoded(const std::string& bytes);
/// Whether the bytes begin as encoded() does.
bool is_encoded(const std::string& bytes);

}  // namespace geometry_io

// SPDX-License-Identifier: GPL-2.0-or-later
// A checksum in front of our own HDF5 files, in the user block that HDF5 leaves to its users.  A file that
// bears it is as this program wrote it, so HDF5's library reads it without harm; whether it does is seen
// without HDF5.
#pragma once

#include <cstddef>
#include <string>

namespace geometry_io {

constexpr std::size_t kSealSize = 512;  // the smallest user block

/// Writes the seal over the first kSealSize bytes of a file that has this user block.
void seal(std::string& file);
/// Whether a file bears the seal, and not a byte has changed since.
bool is_sealed(const std::string& file);
/// Whether it begins as sealed files do, be it cut short.
bool begins_with_seal(const std::string& file);

}  // namespace geometry_io

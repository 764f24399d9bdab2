// SPDX-License-Identifier: GPL-2.0-or-later
// What a file is, by its first bytes and by its name: files of other programs are refused before a parser
// makes nonsense of them.
#pragma once

#include <string>
#include <string_view>

namespace geometry_io {

enum class FileKind { text, hdf5, xml, step, iges, stl, binary };

/// By the first bytes, else, for the foreign ones, by the extension; `text` is what shows no other sign.
FileKind kind_of_file(const std::string& path, const std::string& bytes);

/// Whether an STL file, whole or not, is meant to be a binary one.
bool is_binary_stl(std::string_view bytes);

/// Throws InputError, as expect_kind, of a file that is no text.
[[noreturn]] void refuse_kind(FileKind given, const std::string& path);
/// Throws InputError "x.step: is a STEP file, expected ..., ..." with the way out, unless `bytes` may be what
/// a reader of `expected` (text: YAML) can read.
void expect_kind(FileKind expected, const std::string& path, const std::string& bytes);

}  // namespace geometry_io

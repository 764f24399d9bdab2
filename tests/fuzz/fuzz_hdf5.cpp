// SPDX-License-Identifier: GPL-2.0-or-later
// What nurbs-read-hdf5 hands over of a geometry file in HDF5: behind it no code of HDF5 runs.  In the input
// blanks and line ends between the pieces are left out, `#` and a decimal number stand for a count, `=` and a
// number for a value, so that mutations of a text reach all of it.
#include <cstdint>
#include <cstring>

#include "fuzz_target.h"
#include "geometry_io/geometry_io.h"
#include "geometry_io/hdf5_contents.h"

namespace {

template <class Number>
void append(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

// "#3" -> eight bytes of an integer, "=0.5" -> of a floating-point number, "@2" -> one byte, "'text'" -> its
// length and itself; the rest as it is.
std::string binary(const std::string& text) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char* const rest = text.c_str() + i + 1;
    char* end = const_cast<char*>(rest);
    if (text[i] == '#')
      append<std::uint64_t>(bytes, std::strtoull(rest, &end, 10));
    else if (text[i] == '=')
      append<double>(bytes, std::strtod(rest, &end));
    else if (text[i] == '@')
      append<std::uint8_t>(bytes, static_cast<std::uint8_t>(std::strtoul(rest, &end, 10)));
    else if (const std::size_t quote = text.find('\'', i + 1);
             text[i] == '\'' && quote != std::string::npos) {
      append<std::uint64_t>(bytes, quote - i - 1);
      bytes += text.substr(i + 1, quote - i - 1);
      end += quote - i;
    } else if (text[i] != ' ' && text[i] != '\n') {
      bytes += text[i];
    }
    i += end - rest;
  }
  return bytes;
}

}  // namespace

void fuzz_one(const std::string& input) {
  const std::string bytes = geometry_io::encoded({}) + binary(input);
  const geometry_io::GeometryFile geometry =
      geometry_io::read_geometry("wall.h5", [&](const std::string&) { return bytes; });
  for (const auto& surface : geometry.surfaces)
    geometry_io::named_surface(geometry, surface.first, "wall.h5");
  check_that(geometry_io::encoded(geometry_io::decoded(bytes)).size() <= bytes.size());
}

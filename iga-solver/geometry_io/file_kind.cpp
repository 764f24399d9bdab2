// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/file_kind.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "geometry_io/input_error.h"

namespace geometry_io {
namespace {

using std::string_view;

constexpr std::size_t kHead = 4096;  // bytes that are looked at
constexpr string_view kHdf5Signature("\x89HDF\r\n\x1a\n", 8);

char lower(unsigned char c) { return static_cast<char>(std::tolower(c)); }

bool starts_with(string_view text, string_view start) { return text.substr(0, start.size()) == start; }

// Behind blanks and a byte order mark.
string_view first_word(string_view bytes) {
  if (starts_with(bytes, "\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
  return begin == string_view::npos ? string_view() : bytes.substr(begin);
}

// The signature stands at 0, or behind a user block of 512 bytes, 1024, 2048 ...
bool is_hdf5(string_view bytes) {
  for (std::size_t at = 0; at < bytes.size(); at = at == 0 ? 512 : 2 * at)
    if (starts_with(bytes.substr(at), kHdf5Signature)) return true;
  return false;
}

// "<?xml", "<!--", "<xml"; but not "<<", a key of YAML.
bool is_xml(string_view bytes) {
  const string_view head = first_word(bytes);
  return head.size() > 1 && head[0] == '<' &&
         (head[1] == '?' || head[1] == '!' || std::isalpha(static_cast<unsigned char>(head[1])) != 0);
}

// ISO 10303-21.
bool is_step(string_view bytes) { return starts_with(first_word(bytes), "ISO-10303-21"); }

// Lines of 80 columns; column 73 names the section, the line's number follows.
bool is_iges(string_view bytes) {
  const string_view line = bytes.substr(0, std::min(bytes.find_first_of("\r\n"), bytes.size()));
  return line.size() == 80 && (line[72] == 'S' || line[72] == 'C' || line[72] == 'F') &&
         line.find_first_not_of(" 0", 73) == 79 && line[79] == '1';
}

// "solid", in capitals or not, and what follows it.
bool is_text_stl(string_view bytes) {
  std::string head(first_word(bytes.substr(0, kHead)));
  std::transform(head.begin(), head.end(), head.begin(), lower);
  return starts_with(head, "solid") && head.size() > 5 && std::isspace(static_cast<unsigned char>(head[5])) &&
         (head.find("facet") != string_view::npos || head.find("endsolid") != string_view::npos);
}

// 80 bytes of anything, the number of triangles, and 50 bytes for each.  No text of less than GBs has such a
// number there.
bool has_size_of_stl(string_view bytes) {
  if (bytes.size() < 84) return false;
  std::uint64_t count = 0;
  for (int i = 3; i >= 0; --i) count = 256 * count + static_cast<unsigned char>(bytes[80 + i]);
  return bytes.size() == 84 + 50 * count;
}

bool is_stl(string_view bytes) { return is_text_stl(bytes) || has_size_of_stl(bytes); }

// Control characters that no text has; UTF-16 and UTF-32 have NULs behind their mark.
bool is_binary(string_view bytes) {
  const string_view head = bytes.substr(0, kHead);
  if (starts_with(head, "\xFF\xFE") || starts_with(head, "\xFE\xFF") ||
      starts_with(head, string_view("\0\0\xFE\xFF", 4)))
    return false;
  return std::any_of(head.begin(), head.end(),
                     [](unsigned char c) { return c < '\t' || (c > '\r' && c < ' '); });
}

struct KnownKind {
  FileKind kind;
  const char* name;
  bool (*is)(string_view bytes);
  std::initializer_list<const char*> extensions;  // of foreign files, in lower case
  const char* way_out;
};

constexpr const char* kCadFile =
    "expected another kind of file by its name: STEP is called .step or .stp, IGES .iges or .igs, and a file "
    "in YAML takes it by 'geometry: {file: NAME}'";
constexpr const char* kStlFile =
    "expected NURBS patches, or a file that names this one: triangles are read from files called .stl, and a "
    "file in YAML takes them by 'geometry: {file: NAME}'";

// In the order in which they are asked.
const KnownKind kKnownKinds[] = {
    {FileKind::hdf5,
     "an HDF5 file",
     is_hdf5,
     {},
     "expected text: a geometry in HDF5 is called .h5 or .hdf5, and a model file (YAML) takes it by "
     "'geometry: {file: NAME}'"},
    {FileKind::step, "a STEP file", is_step, {".step", ".stp", ".p21"}, kCadFile},
    {FileKind::iges, "an IGES file", is_iges, {".iges", ".igs"}, kCadFile},
    {FileKind::stl, "an STL file", is_stl, {".stl"}, kStlFile},
    {FileKind::xml,
     "an XML file",
     is_xml,
     {},
     "expected YAML: a geometry in G+Smo's XML is called .xml, and a model file (YAML) takes it by "
     "'geometry: {file: NAME}'"},
    {FileKind::binary, "a binary file", is_binary, {}, "expected YAML, HDF5 (.h5) or G+Smo's XML (.xml)"},
};

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), lower);
  return extension;
}

}  // namespace

FileKind kind_of_file(const std::string& path, const std::string& bytes) {
  for (const KnownKind& kind : kKnownKinds)
    if (kind.is(bytes)) return kind.kind;
  const std::string extension = extension_of(path);
  for (const KnownKind& kind : kKnownKinds)
    for (const char* one : kind.extensions)
      if (extension == one) return kind.kind;
  return FileKind::text;
}

bool is_binary_stl(string_view bytes) {
  return has_size_of_stl(bytes) || (!is_text_stl(bytes) && is_binary(bytes));
}

void refuse_kind(FileKind given, const std::string& path) {
  for (const KnownKind& kind : kKnownKinds)
    if (kind.kind == given) throw InputError(path + ": is " + kind.name + ", " + kind.way_out);
  throw InputError(path + ": is text");
}

void expect_kind(FileKind expected, const std::string& path, const std::string& bytes) {
  const FileKind given = kind_of_file(path, bytes);
  if (given == expected || given == FileKind::text)
    return;  // a text may be broken XML: its parser says where
  refuse_kind(given, path);
}

}  // namespace geometry_io

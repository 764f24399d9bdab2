// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <limits>
#include <new>

#include "geometry_io/file_kind.h"
#include "geometry_io/hdf5_file.h"
#include "geometry_io/hdf5_seal.h"
#include "geometry_io/input_error.h"
#include "geometry_io/reader_process.h"
#include "nurbs/memory.h"

namespace geometry_io {
namespace {

using Kind = Hdf5Value::Kind;

const char* described(Kind kind) {
  switch (kind) {
    case Kind::integers:
      return "whole numbers";
    case Kind::numbers:
      return "numbers";
    case Kind::texts:
      return "text";
    default:
      return "values of another type";
  }
}

void expect_hdf5(const std::string& bytes, const std::string& file) {
  if (begins_with_seal(bytes)) return;
  const FileKind kind = kind_of_file(file, bytes);
  if (kind == FileKind::hdf5) return;
  if (kind != FileKind::xml && kind != FileKind::binary) expect_kind(FileKind::hdf5, file, bytes);
  throw InputError(file + ": is no HDF5 file, expected one by its name");
}

// h5repack keeps the user block, and with it the checksum.
constexpr const char* kChanged =
    "changed since it was written (its checksum differs): damaged or incomplete, or edited by another "
    "program; 'h5unjam --delete -i FILE -o NEW' (or h5py: copy into a new file) makes one without a checksum";

}  // namespace

std::string shape_text(const std::vector<std::uint64_t>& shape) {
  std::string text;
  for (const std::uint64_t n : shape) text += fmt::format("[{}]", n);
  return text.empty() ? "one value" : text;
}

std::string unpacked_hdf5(const std::string& bytes, const std::string& file) {
  expect_hdf5(bytes, file);
  try {
    if (is_sealed(bytes)) return encoded(unpack_hdf5(bytes));
    if (begins_with_seal(bytes)) throw std::runtime_error(kChanged);
    return read_in_own_process(kHdf5Reader, bytes);
  } catch (const std::bad_alloc&) {
    throw InputError(nurbs::out_of_memory(file));
  } catch (const std::runtime_error& error) {
    throw InputError(file + ": " + error.what());
  }
}

Hdf5Input::Hdf5Input(const std::string& bytes, std::string file) : file_name_(std::move(file)) {
  try {
    contents_ = decoded(is_encoded(bytes) ? bytes : unpacked_hdf5(bytes, file_name_));
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw InputError(nurbs::out_of_memory(file_name_));
  } catch (const std::runtime_error& error) {
    throw InputError(file_name_ + ": " + error.what());
  }
}

void Hdf5Input::fail(const std::string& path, const std::string& message) const {
  throw InputError(fmt::format("{}: {}: {}", file_name_, path, message));
}

bool Hdf5Input::has(const std::string& path, const char* attribute) const {
  const auto found = contents_.find(path);
  return found != contents_.end() && found->second.attributes.count(attribute) > 0;
}

const Hdf5Object& Hdf5Input::object(const std::string& path) const {
  const auto found = contents_.find(path);
  if (found == contents_.end()) fail(path, "is missing");
  return found->second;
}

const Hdf5Value& Hdf5Input::attribute(const std::string& path, const char* name) const {
  const auto& attributes = object(path).attributes;
  const auto found = attributes.find(name);
  if (found == attributes.end()) fail(path, fmt::format("attribute '{}' is missing", name));
  if (!found->second.problem.empty())
    fail(path, fmt::format("attribute '{}' {}", name, found->second.problem));
  return found->second;
}

const Hdf5Value& Hdf5Input::data_set(const std::string& path) const {
  const Hdf5Object& found = object(path);
  if (found.is_group) fail(path, "is no data set, expected one");
  if (!found.values.problem.empty()) fail(path, found.values.problem);
  return found.values;
}

const std::string& Hdf5Input::text(const std::string& path, const char* name) const {
  const Hdf5Value& value = attribute(path, name);
  if (value.kind != Kind::texts)
    fail(path, fmt::format("attribute '{}' holds {}, expected text", name, described(value.kind)));
  if (value.texts.size() != 1)
    fail(path, fmt::format("attribute '{}' has {} texts, expected one", name, value.texts.size()));
  return value.texts.front();
}

const std::vector<std::string>& Hdf5Input::texts(const std::string& path) const {
  const Hdf5Value& value = data_set(path);
  if (value.kind != Kind::texts) fail(path, fmt::format("holds {}, expected text", described(value.kind)));
  return value.texts;
}

std::vector<int> Hdf5Input::integers(const std::string& path, const char* name) const {
  const Hdf5Value& value = attribute(path, name);
  std::vector<int> integers;
  for (const double x : value.numbers) {
    if (!(x >= std::numeric_limits<int>::min() && x <= std::numeric_limits<int>::max()))
      fail(path, fmt::format("attribute '{}' is {}, expected a smaller number", name, x));
    integers.push_back(static_cast<int>(x));
  }
  if (value.kind != Kind::integers)
    fail(path, fmt::format("attribute '{}' holds {}, expected whole numbers", name, described(value.kind)));
  return integers;
}

std::vector<std::string> Hdf5Input::members(const std::string& path) const {
  if (!object(path).is_group) fail(path, "is no group, expected one");
  const std::string start = path + "/";
  std::vector<std::string> names;
  for (auto entry = contents_.upper_bound(start); entry != contents_.end(); ++entry) {
    if (entry->first.compare(0, start.size(), start) != 0) break;
    if (entry->first.find('/', start.size()) == std::string::npos)
      names.push_back(entry->first.substr(start.size()));
  }
  return names;
}

const Hdf5Value& Hdf5Input::numbers(const std::string& path) const {
  const Hdf5Value& value = data_set(path);
  if (value.kind != Kind::numbers && value.kind != Kind::integers)
    fail(path, fmt::format("holds {}, expected numbers", described(value.kind)));
  return value;
}

}  // namespace geometry_io

// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/hdf5_contents.h"

#include <cstring>
#include <limits>
#include <stdexcept>

namespace geometry_io {
namespace {

constexpr const char* kMagic = "contents of an HDF5 file, version 1\n";

class Writer {
 public:
  Writer() : bytes_(kMagic) {}
  void count(std::uint64_t n) { raw(&n, sizeof n); }
  void flag(std::uint8_t byte) { raw(&byte, 1); }
  void text(const std::string& text) {
    count(text.size());
    bytes_ += text;
  }
  void value(const Hdf5Value& value) {
    flag(static_cast<std::uint8_t>(value.kind));
    text(value.problem);
    count(value.shape.size());
    for (const std::uint64_t n : value.shape) count(n);
    count(value.numbers.size());
    raw(value.numbers.data(), value.numbers.size() * sizeof(double));
    count(value.texts.size());
    for (const std::string& one : value.texts) text(one);
  }
  std::string bytes() && { return std::move(bytes_); }

 private:
  void raw(const void* from, std::size_t size) { bytes_.append(static_cast<const char*>(from), size); }
  std::string bytes_;
};

// Every number of things is held against the bytes that are left before anything is allocated for them.
class Reader {
 public:
  explicit Reader(const std::string& bytes) : bytes_(bytes), next_(std::strlen(kMagic)) {
    if (!is_encoded(bytes)) fail();
  }
  bool at_end() const { return next_ == bytes_.size(); }
  std::uint64_t count(std::size_t least_size_of_one) {
    std::uint64_t n = 0;
    raw(&n, sizeof n);
    if (n > (bytes_.size() - next_) / least_size_of_one) fail();
    return n;
  }
  std::uint64_t number() {
    std::uint64_t n = 0;
    raw(&n, sizeof n);
    return n;
  }
  std::uint8_t flag(std::uint8_t highest) {
    std::uint8_t byte = 0;
    raw(&byte, 1);
    if (byte > highest) fail();
    return byte;
  }
  std::string text() {
    std::string text(count(1), '\0');
    raw(text.data(), text.size());
    return text;
  }
  Hdf5Value value() {
    Hdf5Value value;
    value.kind = static_cast<Hdf5Value::Kind>(flag(static_cast<std::uint8_t>(Hdf5Value::Kind::other)));
    value.problem = text();
    value.shape.resize(count(sizeof(std::uint64_t)));
    for (std::uint64_t& n : value.shape) n = number();
    value.numbers.resize(count(sizeof(double)));
    raw(value.numbers.data(), value.numbers.size() * sizeof(double));
    value.texts.resize(count(sizeof(std::uint64_t)));
    for (std::string& one : value.texts) one = text();
    check_shape(value);
    return value;
  }

 private:
  [[noreturn]] static void fail() {
    throw std::runtime_error("contents of an HDF5 file that are cut short or damaged");
  }

  void raw(void* to, std::size_t size) {
    if (size > bytes_.size() - next_) fail();
    if (size > 0) std::memcpy(to, bytes_.data() + next_, size);
    next_ += size;
  }
  // Values, if there are any, are as many as the shape says, and of the kind.
  static void check_shape(const Hdf5Value& value) {
    const bool is_text = value.kind == Hdf5Value::Kind::texts;
    const std::size_t given = is_text ? value.texts.size() : value.numbers.size();
    if (!(is_text ? value.numbers.empty() : value.texts.empty())) fail();
    if (value.kind == Hdf5Value::Kind::other || !value.problem.empty()) {
      if (given != 0) fail();
      return;
    }
    std::uint64_t expected = 1;
    for (const std::uint64_t n : value.shape) {
      if (n != 0 && expected > std::numeric_limits<std::uint64_t>::max() / n) fail();
      expected *= n;
    }
    if (given != expected) fail();
  }

  const std::string& bytes_;
  std::size_t next_;
};

}  // namespace

bool is_encoded(const std::string& bytes) { return bytes.compare(0, std::strlen(kMagic), kMagic) == 0; }

std::string encoded(const Hdf5Contents& contents) {
  Writer writer;
  for (const auto& [path, object] : contents) {
    writer.text(path);
    writer.flag(object.is_group);
    if (!object.is_group) writer.value(object.values);
    writer.count(object.attributes.size());
    for (const auto& [name, value] : object.attributes) {
      writer.text(name);
      writer.value(value);
    }
  }
  return std::move(writer).bytes();
}

Hdf5Contents decoded(const std::string& bytes) {
  Reader reader(bytes);
  Hdf5Contents contents;
  while (!reader.at_end()) {
    Hdf5Object& object = contents[reader.text()];
    object.is_group = reader.flag(1) != 0;
    if (!object.is_group) object.values = reader.value();
    for (std::uint64_t left = reader.count(sizeof(std::uint64_t)); left > 0; --left) {
      const std::string name = reader.text();
      object.attributes[name] = reader.value();
    }
  }
  return contents;
}

}  // namespace geometry_io

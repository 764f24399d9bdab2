// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_state.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "parallel/all_or_none.h"

namespace liggghts_pkg {

namespace {

constexpr double kVersion = 4.0;  // 3 stands where a state is in blocks (state_blocks.cpp)

class PartReader {
 public:
  PartReader(const char* bytes, std::size_t numbers) : next_(bytes), left_(numbers) {}

  double peek() const {
    if (left_ == 0) coupling::fail_as_damaged();
    double number;
    std::memcpy(&number, next_, sizeof number);
    return number;
  }
  void skip_number() {
    next_ += sizeof(double);
    --left_;
  }
  std::vector<double> part() {
    const double size = peek();
    skip_number();
    std::vector<double> numbers(coupling::saved_size(size, left_));
    left_ -= numbers.size();
    if (!numbers.empty()) std::memcpy(numbers.data(), next_, numbers.size() * sizeof(double));
    next_ += numbers.size() * sizeof(double);
    return numbers;
  }

 private:
  const char* next_;
  std::size_t left_;  // numbers, at most
};

}  // namespace

std::vector<double> pack(const WallState& state) {
  const WallState::Origin& origin = state.origin.value();
  const std::vector<double> memory = {static_cast<double>(origin.contacts),
                                      static_cast<double>(origin.history)};
  const std::vector<double> fingerprint = coupling::to_numbers(origin.fingerprint);
  const std::vector<double>* const parts[] = {&state.structure, &state.fields, &fingerprint, &memory,
                                              &state.contacts};
  std::size_t numbers = 1;
  for (const std::vector<double>* part : parts) numbers += 1 + part->size();
  std::vector<double> all{-kVersion};
  all.reserve(numbers);
  for (const std::vector<double>* part : parts) {
    all.push_back(static_cast<double>(part->size()));
    all.insert(all.end(), part->begin(), part->end());
  }
  return all;
}

WallState unpack_wall_state(const char* bytes, std::size_t numbers) {
  PartReader reader(bytes, numbers);
  const double version = reader.peek() < 0.0 ? -reader.peek() : 1.0;
  if (version > kVersion)
    throw std::invalid_argument(
        fmt::format("the restart file was written by a newer version (format {:g}, expected at most {:g})",
                    version, kVersion));
  if (version > 1.0) reader.skip_number();
  WallState state;
  state.structure = reader.part();
  state.fields = reader.part();
  if (version == 1.0) return state;
  const coupling::Fingerprint fingerprint = coupling::fingerprint_from(reader.part());
  const std::vector<double> memory = reader.part();
  if (memory.size() < 2) coupling::fail_as_damaged();
  const auto count = [](double number) {
    return static_cast<int>(coupling::saved_size(number, std::numeric_limits<int>::max()));
  };
  state.origin = {fingerprint, count(memory[0]), count(memory[1])};
  if (version > 3.0) state.contacts = reader.part();
  return state;
}

void check_origin(const WallState::Origin& saved, const WallState::Origin& now, const std::string& file) {
  const std::string differs = coupling::difference(saved.fingerprint, now.fingerprint);
  if (!differs.empty())
    throw std::invalid_argument(fmt::format(
        "the restart file holds the state of something else than '{}': {}; expected the same geometry, "
        "mesh, material, supports and units: use the file of then, or give the fix another ID, which starts "
        "the wall anew",
        file, differs));
  if (saved.history != now.history)
    throw std::invalid_argument(fmt::format(
        "the restart file holds contacts of {} history values each, the contact models here keep {}; use the "
        "models, and the word after 'compliance', of then, or give the fix another ID, which starts the wall "
        "anew",
        saved.history, now.history));
  if (saved.contacts > now.contacts)
    throw std::invalid_argument(
        fmt::format("the restart file holds up to {0} contacts of a particle, expected at most {1} with "
                    "'contacts {1}'; use 'contacts {0}'",
                    saved.contacts, now.contacts));
}

void write_block(MPI_Comm world, std::FILE* file, const std::vector<double>& numbers) {
  const int bytes = static_cast<int>(numbers.size() * sizeof(double));
  parallel::on_first_rank(world, [&] {
    if (std::fwrite(&bytes, sizeof(int), 1, file) != 1 ||
        std::fwrite(numbers.data(), sizeof(double), numbers.size(), file) != numbers.size() ||
        std::fflush(file) != 0)
      throw std::runtime_error(fmt::format(
          "cannot write its {} bytes to the restart file: {}; make room, or write the file elsewhere", bytes,
          std::strerror(errno)));
  });
}

}  // namespace liggghts_pkg

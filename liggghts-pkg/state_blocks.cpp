// SPDX-License-Identifier: GPL-2.0-or-later
#include "state_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "coupling/fingerprint.h"
#include "fix_wall_nurbs_state.h"
#include "modify.h"

namespace liggghts_pkg {

using LAMMPS_NS::FixWallNurbsState;

namespace {

constexpr double kInBlocks = -3.0;  // where the version of a state in one block stands (wall_state.cpp)
constexpr std::size_t kHead = 3;    // of the wall's own block: kInBlocks, numbers of the state, of this block

constexpr std::size_t kMostNumbers = std::size_t{1} << 27;  // of a block: a gibibyte

// Tests make blocks small: LIGGGHTS_NURBS_RESTART_BLOCK, in numbers.
std::size_t block_size() {
  const char* const given = std::getenv("LIGGGHTS_NURBS_RESTART_BLOCK");
  const std::size_t numbers = given ? std::strtoul(given, nullptr, 10) : kMostNumbers;
  return std::clamp<std::size_t>(numbers, 1, kMostNumbers);
}

}  // namespace

StateBlocks::StateBlocks(LAMMPS_NS::Modify& modify, const std::string& wall_id)
    : modify_(modify), wall_id_(wall_id), block_size_(block_size()) {}

std::string StateBlocks::helper_id(std::size_t k) const { return fmt::format("state{}_{}", k + 2, wall_id_); }

FixWallNurbsState* StateBlocks::helper(std::size_t k) const {
  const int place = modify_.find_fix(helper_id(k).c_str());
  return place < 0 ? nullptr : dynamic_cast<FixWallNurbsState*>(modify_.fix[place]);
}

void StateBlocks::reserve(std::size_t numbers) {
  while ((helpers_ + 1) * block_size_ < numbers) add_helper();
}

void StateBlocks::add_helper() {
  std::string id = helper_id(helpers_), group = "all", style = "wall/nurbs/state";
  char* arg[] = {id.data(), group.data(), style.data()};
  modify_.add_fix(3, arg);
  ++helpers_;
}

std::vector<double> StateBlocks::split(std::vector<double> state) {
  if (state.size() <= block_size_) return state;
  std::vector<double> own = {kInBlocks, static_cast<double>(state.size()), static_cast<double>(block_size_)};
  own.insert(own.end(), state.begin(), state.begin() + block_size_);
  std::size_t first = block_size_;
  for (std::size_t k = 0; first < state.size(); ++k, first += block_size_) {
    FixWallNurbsState* const fix = helper(k);
    if (!fix)
      throw std::runtime_error(
          fmt::format("its fix '{0}', which writes a part of its state, is missing; do not unfix it, or "
                      "'unfix {1}' and define the wall anew",
                      helper_id(k), wall_id_));
    const std::size_t end = std::min(first + block_size_, state.size());
    fix->block.assign(state.begin() + first, state.begin() + end);
  }
  return own;
}

std::vector<double> StateBlocks::joined(const char* own_block) {
  double head[kHead];
  std::memcpy(head, own_block, sizeof(double));
  if (head[0] != kInBlocks) return {};
  std::memcpy(head, own_block, sizeof head);
  constexpr std::size_t kMost = std::size_t{1} << 40;
  const std::size_t size = coupling::saved_size(head[1], kMost);
  std::vector<double> state(coupling::saved_size(head[2], std::min(size, kMostNumbers)));
  std::memcpy(state.data(), own_block + sizeof head, state.size() * sizeof(double));
  while (state.size() < size) {
    add_helper();  // LIGGGHTS hands it its block
    std::vector<double>& block = helper(helpers_ - 1)->block;
    if (block.empty() || block.size() > size - state.size()) coupling::fail_as_damaged();
    state.insert(state.end(), block.begin(), block.end());
    block = {};
  }
  return state;
}

void StateBlocks::remove() {
  for (std::size_t k = 0; k < helpers_; ++k)
    if (helper(k)) modify_.delete_fix(helper_id(k).c_str());
}

}  // namespace liggghts_pkg

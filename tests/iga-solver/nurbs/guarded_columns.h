// SPDX-License-Identifier: GPL-2.0-or-later
// Memory that nobody may touch: who reads or writes it ends the test with a segmentation fault.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>

#include "nurbs/types.h"

namespace nurbs {

/// All whole pages of the columns from `first` on, as long as this lives; the matrix must outlive it.
class GuardedColumns {
 public:
  GuardedColumns(const NodalVectors& matrix, Eigen::Index first) {
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    const auto address = [&](Eigen::Index column) {
      return reinterpret_cast<std::uintptr_t>(matrix.data() + 3 * column);
    };
    begin_ = (address(first) + page - 1) / page * page;
    const std::uintptr_t end = address(matrix.cols()) / page * page;
    pages_ = end > begin_ ? static_cast<int>((end - begin_) / page) : 0;
    size_ = pages_ * page;
    if (pages_ > 0 && mprotect(reinterpret_cast<void*>(begin_), size_, PROT_NONE) != 0) pages_ = 0;
  }
  ~GuardedColumns() {
    if (pages_ > 0) mprotect(reinterpret_cast<void*>(begin_), size_, PROT_READ | PROT_WRITE);
  }
  GuardedColumns(const GuardedColumns&) = delete;
  GuardedColumns& operator=(const GuardedColumns&) = delete;

  int pages() const { return pages_; }

 private:
  std::uintptr_t begin_;
  std::size_t size_;
  int pages_;
};

}  // namespace nurbs

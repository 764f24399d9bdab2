// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/table_memory.h"

#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace structure {

namespace {

constexpr std::size_t kPage = std::size_t(1) << 21;

class LargePages final : public std::pmr::memory_resource {
  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    if (alignment > kPage) throw std::bad_alloc();
    const std::size_t whole = (bytes + kPage - 1) / kPage * kPage;
    void* const memory = std::aligned_alloc(kPage, whole);
    if (memory == nullptr) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    madvise(memory, whole, MADV_HUGEPAGE);  // a wish: without them it is slower, not wrong
#endif
    return memory;
  }
  void do_deallocate(void* memory, std::size_t, std::size_t) override { std::free(memory); }
  bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override { return this == &other; }
};

struct TableMemory {
  static constexpr std::size_t kLargestTable = 8192, kOwn = 64;  // kOwn: what a buffer keeps of itself
  LargePages pages;
  std::pmr::monotonic_buffer_resource buffer{kPage - kOwn, &pages};
  std::pmr::synchronized_pool_resource tables{{0, kLargestTable}, &buffer};
};

}  // namespace

std::pmr::memory_resource& table_memory() {
  static TableMemory& memory = *new TableMemory;  // tables may outlive what is static
  return memory.tables;
}

}  // namespace structure

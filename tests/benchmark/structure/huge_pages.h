// SPDX-License-Identifier: GPL-2.0-or-later
// Long arrays in pages of 2 MB, where the system has them: reading one from end to end looks up few
// addresses.
#pragma once

#include <sys/mman.h>

#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

namespace benchmarks {

template <class T>
struct HugePages {
  using value_type = T;
  HugePages() = default;
  template <class U>
  HugePages(const HugePages<U>&) {}

  T* allocate(std::size_t count) {
    constexpr std::size_t kPage = std::size_t(1) << 21;
    const std::size_t bytes = (count * sizeof(T) + kPage - 1) / kPage * kPage;
    void* memory = std::aligned_alloc(kPage, bytes);
    if (memory == nullptr) throw std::bad_alloc();
    madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: without them it is slower, not wrong
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }
  bool operator==(const HugePages&) const { return true; }
  bool operator!=(const HugePages&) const { return false; }
};

template <class T>
using LongVector = std::vector<T, HugePages<T>>;

/// A copy.
template <class T>
std::shared_ptr<const LongVector<T>> in_huge_pages(const T* first, std::size_t count) {
  return std::make_shared<const LongVector<T>>(first, first + count);
}

}  // namespace benchmarks

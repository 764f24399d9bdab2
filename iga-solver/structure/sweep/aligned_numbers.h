// SPDX-License-Identifier: GPL-2.0-or-later
// Arrays whose words do not straddle lines of the cache.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace structure {

template <class T>
struct CacheAligned {
  using value_type = T;
  static constexpr std::align_val_t kLine{64};
  CacheAligned() = default;
  template <class U>
  CacheAligned(const CacheAligned<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kLine)); }
  void deallocate(T* numbers, std::size_t) { ::operator delete(numbers, kLine); }
  bool operator==(const CacheAligned&) const { return true; }
  bool operator!=(const CacheAligned&) const { return false; }
};

using AlignedNumbers = std::vector<double, CacheAligned<double>>;

/// At least so many.
inline void grow(AlignedNumbers& numbers, std::size_t size) {
  if (numbers.size() < size) numbers.resize(size, 0.0);
}

}  // namespace structure

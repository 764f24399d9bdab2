// SPDX-License-Identifier: GPL-2.0-or-later
// Where tables are: side by side in pages of 2 MB, where the system has them.  Each contact reads another
// table, and each table would be on pages of its own, whose addresses are looked up before anything comes
// from them: of a contact on rational elements, 40 of 500 ns.
#pragma once

#include <memory_resource>

namespace structure {

/// Of all tables of the process, for as long as it runs; what is given back serves others.
std::pmr::memory_resource& table_memory();

/// Things of which many are made, one by one.
template <class Thing>
struct InTableMemory {
  static void* operator new(std::size_t bytes) { return table_memory().allocate(bytes, alignof(Thing)); }
  static void operator delete(void* thing, std::size_t bytes) {
    table_memory().deallocate(thing, bytes, alignof(Thing));
  }
};

}  // namespace structure

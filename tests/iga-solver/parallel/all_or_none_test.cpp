// SPDX-License-Identifier: GPL-2.0-or-later
// What fails on one rank fails on all of them, with the same words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

#include "geometry_io/input_error.h"
#include "parallel/all_or_none.h"

namespace {

using parallel::on_every_rank;
using parallel::on_first_rank;
using testing::HasSubstr;
using testing::StrEq;
using testing::ThrowsMessage;

int ranks() {
  int size;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}
int rank() {
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

TEST(OnEveryRank, GivesEachItsResult) {
  EXPECT_EQ(on_every_rank(MPI_COMM_WORLD, "plate.yaml", [] { return rank(); }), rank());
}

TEST(OnEveryRank, FailsOnAllWhereOneFails) {
  const auto fail_on = [](int which) {
    return on_every_rank(MPI_COMM_WORLD, "plate.yaml", [=] {
      if (rank() == which) throw std::invalid_argument("plate.yaml:3: no such thing");
      return 0;
    });
  };
  for (int which = 0; which < ranks(); ++which)
    EXPECT_THAT([&] { fail_on(which); },
                ThrowsMessage<geometry_io::InputError>(StrEq("plate.yaml:3: no such thing")));
}

TEST(OnEveryRank, SaysWhichFileTheMemoryOfOneDoesNotHold) {
  const auto fail_on_last = [] {
    return on_every_rank(MPI_COMM_WORLD, "plate.yaml", [] {
      if (rank() == ranks() - 1) throw std::bad_alloc();
      return 0;
    });
  };
  EXPECT_THAT(fail_on_last, ThrowsMessage<geometry_io::InputError>(HasSubstr("plate.yaml: out of memory: ")));
}

TEST(OnFirstRank, ActsThereAlone) {
  int acted = 0;
  on_first_rank(MPI_COMM_WORLD, [&] { ++acted; });
  EXPECT_EQ(acted, rank() == 0 ? 1 : 0);
}

TEST(OnFirstRank, FailsOnAll) {
  const auto fail = [] {
    on_first_rank(MPI_COMM_WORLD, [] { throw std::invalid_argument("no room for wall.pvd"); });
  };
  EXPECT_THAT(fail, ThrowsMessage<geometry_io::InputError>(StrEq("no room for wall.pvd")));
}

TEST(OnFirstRank, SaysThatMemoryEnded) {
  const auto fail = [] { on_first_rank(MPI_COMM_WORLD, [] { throw std::bad_alloc(); }); };
  EXPECT_THAT(fail,
              ThrowsMessage<geometry_io::InputError>(HasSubstr("out of memory: this process may have")));
}

TEST(AllOrNone, TakeAnErrorWithoutWordsForOne) {
  const auto every = [] {
    return on_every_rank(MPI_COMM_WORLD, "plate.yaml", []() -> int { throw std::runtime_error(""); });
  };
  const auto first = [] { on_first_rank(MPI_COMM_WORLD, [] { throw std::runtime_error(""); }); };
  EXPECT_THAT(every, ThrowsMessage<geometry_io::InputError>(HasSubstr("without a message")));
  EXPECT_THAT(first, ThrowsMessage<geometry_io::InputError>(HasSubstr("without a message")));
}

}  // namespace

// SPDX-License-Identifier: GPL-2.0-or-later
// GoogleTest main for tests that run on several ranks; fails if any rank fails.  Arguments: source files
// whose tests are run, as kink_test.cpp; all if there are none.
#include <gtest/gtest.h>
#include <mpi.h>

#include <cstdio>
#include <string>

namespace {

/// For --gtest_filter: all tests of a source file; "" if it has none.
std::string tests_of_file(const std::string& name) {
  std::string filter;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const testing::TestInfo& test = *suite.GetTestInfo(t);
      const std::string path = std::string("/") + test.file(), end = "/" + name;
      if (path.size() >= end.size() && path.compare(path.size() - end.size(), end.size(), end) == 0)
        filter += std::string(suite.name()) + "." + test.name() + ":";
    }
  }
  return filter;
}

/// What is wrong with the arguments, if anything.
std::string choose_files(int count, char** names) {
  std::string filter;
  for (int i = 0; i < count; ++i) {
    const std::string tests = tests_of_file(names[i]);
    if (tests.empty()) return std::string(names[i]) + ": expected a source file with tests, as kink_test.cpp";
    filter += tests;
  }
  if (count > 0) testing::GTEST_FLAG(filter) = filter;
  return "";
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  const std::string problem = choose_files(argc - 1, argv + 1);
  if (!problem.empty()) std::fprintf(stderr, "%s\n", problem.c_str());
  int failed = problem.empty() ? RUN_ALL_TESTS() : 1, any = 0;
  MPI_Allreduce(&failed, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return any;
}

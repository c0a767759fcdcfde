// SPDX-License-Identifier: GPL-2.0-or-later
// Coupled tests run under mpirun on the rank counts that their CMake line declares; rank 0 reports.
// Without an argument all tests run. With the name of a source its tests run.

#include <iostream>
#include <string>

#include <gtest/gtest.h>
#include <mpi.h>

namespace {

/// GoogleTest's filter for the tests of <name>.cpp; empty if there are none.
std::string tests_of(const std::string& name) {
  const std::string file = "/" + name + ".cpp";
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  std::string filter;
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int j = 0; j < suite.total_test_count(); ++j) {
      const testing::TestInfo& test = *suite.GetTestInfo(j);
      const std::string source = std::string("/") + test.file();
      if (source.size() >= file.size() &&
          source.compare(source.size() - file.size(), file.size(), file) == 0)
        filter += std::string(suite.name()) + "." + test.name() + ":";
    }
  }
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (argc > 1) {
    const std::string filter = tests_of(argv[1]);
    if (filter.empty()) {
      if (rank == 0) std::cerr << "No test is in a source " << argv[1] << ".cpp\n";
      MPI_Finalize();
      return 2;
    }
    testing::GTEST_FLAG(filter) = filter;
  }
  if (rank != 0)
    delete testing::UnitTest::GetInstance()->listeners().Release(
        testing::UnitTest::GetInstance()->listeners().default_result_printer());
  int failed = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return failed;
}

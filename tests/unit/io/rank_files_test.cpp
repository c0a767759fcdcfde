// SPDX-License-Identifier: GPL-2.0-or-later
// Files of the ranks: whole, or refused by name.
#include "furrow/io/files/rank_files.h"

#include <filesystem>
#include <numeric>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "furrow/core/error.h"
#include "furrow/io/files/replace_file.h"
#include "scratch.h"
#include "size_limit.h"
#include "tests/support/error_of.h"

namespace furrow::test::rank_files_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::vector<double> numbers_from(double first, std::size_t count) {
  std::vector<double> numbers(count);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

std::string write(const std::string& stem, int rank, const std::vector<double>& numbers) {
  RankFiles files(stem, rank);
  for (const double number : numbers) files.append(&number, 1);
  return files.close();
}

std::vector<double> read(const std::string& stem, int rank, std::uint64_t first,
                         std::size_t count) {
  RankFiles files(stem, 0);
  std::vector<double> numbers(count);
  files.check(rank);
  files.read(rank, first, numbers.data(), count);
  return numbers;
}

TEST(RankFiles, EveryRankReadsAnyPartOfAnyFile) {
  const Scratch scratch;
  const std::string stem = scratch.path("new/ck.particles/set.soil");
  EXPECT_EQ(write(stem, 0, numbers_from(0.5, 100)), "");
  EXPECT_EQ(write(stem, 7, numbers_from(-3.0, 10)), "");
  EXPECT_EQ(read(stem, 0, 0, 100), numbers_from(0.5, 100));
  EXPECT_EQ(read(stem, 0, 60, 30), numbers_from(60.5, 30));
  EXPECT_EQ(read(stem, 7, 9, 1), numbers_from(6.0, 1));
  RankFiles both(stem, 0);
  double number = 0.0;
  for (const int rank : {0, 7, 0}) {
    both.read(rank, 1, &number, 1);
    EXPECT_EQ(number, rank == 0 ? 1.5 : -2.0);
  }
}

TEST(RankFiles, RankWithoutNumbersHasNoFile) {
  const Scratch scratch;
  EXPECT_EQ(write(scratch.path("ck/set.soil"), 0, {}), "");
  EXPECT_FALSE(fs::exists(scratch.path("ck")));
}

TEST(RankFiles, UnclosedFileIsRemoved) {
  const Scratch scratch;
  const double number = 1.0;
  { RankFiles(scratch.path("ck/set.soil"), 0).append(&number, 1); }
  EXPECT_TRUE(fs::is_empty(scratch.path("ck")));
}

TEST(RankFiles, MissingOrDamagedFileIsRefusedWithRemedy) {
  const Scratch scratch;
  const std::string stem = scratch.path("ck.particles/set.soil");
  write(stem, 1, numbers_from(0.0, 50));
  EXPECT_THAT(error_of([&] { read(stem, 0, 0, 1); }),
              ::testing::AllOf(HasSubstr("checkpoint is incomplete"), HasSubstr("set.soil.0'"),
                               HasSubstr("No such file"), HasSubstr("keep the folder")));
  EXPECT_THAT(error_of([&] { read(stem, 1, 0, 500); }), HasSubstr("ends too early"));
  std::string bytes = read_text_file(stem + ".1");
  bytes[100] = static_cast<char>(bytes[100] ^ 4);
  write_text_file(stem + ".1", bytes);
  EXPECT_THAT(error_of([&] { read(stem, 1, 0, 1); }), HasSubstr("is damaged"));
  fs::resize_file(stem + ".1", 200);
  EXPECT_THAT(error_of([&] { read(stem, 1, 0, 1); }), HasSubstr("set.soil.1' has no seal"));
}

TEST(RankFiles, FailedWriteIsReportedWhenClosedAndLeavesNothing) {
  const Scratch scratch;
  const std::string stem = scratch.path("ck/set.soil");
  {
    const SizeLimit limit(1000);
    EXPECT_EQ(write(stem, 0, numbers_from(0.0, 50)), "");
    EXPECT_THAT(
        write(stem, 1, numbers_from(0.0, 500)),
        ::testing::AllOf(HasSubstr("set.soil.1' is not written"), HasSubstr("File too large")));
  }
  EXPECT_FALSE(fs::exists(stem + ".1"));
  EXPECT_FALSE(fs::exists(stem + ".1.part"));
  EXPECT_EQ(read(stem, 0, 0, 50), numbers_from(0.0, 50));
}

}  // namespace
}  // namespace furrow::test::rank_files_test

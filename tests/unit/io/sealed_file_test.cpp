// SPDX-License-Identifier: GPL-2.0-or-later
// Whatever happens to a sealed file is noticed: cut at any length, a bit flipped anywhere, foreign.
#include "furrow/io/files/sealed_file.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "furrow/core/error.h"
#include "furrow/io/files/replace_file.h"
#include "scratch.h"
#include "size_limit.h"
#include "tests/support/error_of.h"

namespace furrow::test::sealed_file_test {
namespace {

using State = SealCheck::State;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(SealedFile, ClosedFileIsCompleteAndStartsWithItsContent) {
  const Scratch scratch;
  const std::string path = scratch.path("new/folder/a.restart");
  SealedFile file(path);
  file.write("grains", 6);
  file.write(" and wheels", 11);
  EXPECT_FALSE(std::filesystem::exists(path)) << "a file that is not closed has its name";
  file.close();
  EXPECT_EQ(check_seal(path).state, State::whole) << check_seal(path).problem;
  EXPECT_EQ(read_text_file(path).substr(0, 17), "grains and wheels");
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
}

TEST(SealedFile, UnclosedFileLeavesThePreviousFile) {
  const Scratch scratch;
  const std::string path = scratch.path("a.restart");
  write_sealed_text(path, "first");
  {
    SealedFile file(path);
    file.write("second", 6);
  }
  EXPECT_EQ(read_text_file(path).substr(0, 5), "first");
  EXPECT_EQ(check_seal(path).state, State::whole);
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
}

TEST(SealedFile, TruncationAndBitErrorsAreDetected) {
  const Scratch scratch;
  const std::string path = scratch.path("a.restart");
  write_sealed_text(path, std::string("numbers\0\n\xff of a run", 20));
  const std::string whole = read_text_file(path);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    write_text_file(path, whole.substr(0, length));
    EXPECT_EQ(check_seal(path).state, State::unsealed) << "cut to " << length;
    EXPECT_FALSE(check_seal(path).problem.empty());
  }
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string flipped = whole;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
    write_text_file(path, flipped);
    EXPECT_NE(check_seal(path).state, State::whole) << "bit " << bit;
  }
  for (const std::string& longer : {whole + "\n", whole + whole, "x" + whole}) {
    write_text_file(path, longer);
    EXPECT_NE(check_seal(path).state, State::whole);
  }
}

TEST(SealedFile, UnreadableFileHasAReason) {
  const Scratch scratch;
  EXPECT_THAT(check_seal(scratch.path("missing")).problem, HasSubstr("No such file"));
  EXPECT_EQ(check_seal(scratch.path(".")).problem, "is a folder");
  EXPECT_EQ(check_seal("/dev/null").problem, "is no regular file");
  write_text_file(scratch.path("empty"), "");
  EXPECT_EQ(check_seal(scratch.path("empty")).problem, "is empty");
}

std::string error_of_writing(const std::string& path) {
  return error_of([&] { write_sealed_text(path, "numbers"); });
}

TEST(SealedFile, WriteFailuresNameFileAndReason) {
  const Scratch scratch;
  const std::string full = scratch.path("full.restart");
  {
    const SizeLimit limit(5);
    EXPECT_THAT(error_of_writing(full),
                AllOf(HasSubstr("full.restart' is not written"), HasSubstr("File too large")));
  }
  EXPECT_FALSE(std::filesystem::exists(full));
  EXPECT_FALSE(std::filesystem::exists(full + ".part"));
  EXPECT_THAT(error_of_writing("/proc/nothing/a.restart"), HasSubstr("its folder '/proc/nothing'"));
  std::filesystem::create_directory(scratch.path("folder"));
  EXPECT_THAT(error_of_writing(scratch.path("folder")), HasSubstr("Is a directory"));
}

TEST(SealedFile, LeftoverTemporaryFileIsReplacedAndLinksAreNotFollowed) {
  const Scratch scratch;
  const std::string path = scratch.path("a.restart");
  write_text_file(path + ".part", "cut short");
  write_sealed_text(path, "first");
  EXPECT_EQ(check_seal(path).state, State::whole);
  write_text_file(scratch.path("notes"), "of the user");
  std::filesystem::create_symlink(scratch.path("notes"), path + ".part");
  write_sealed_text(path, "second");
  EXPECT_EQ(read_text_file(scratch.path("notes")), "of the user");
  EXPECT_EQ(read_text_file(path).substr(0, 6), "second");
}

TEST(SealedFile, LockAdmitsOneWriter) {
  const Scratch scratch;
  const std::string path = scratch.path("a.restart");
  SealedFile first(path);
  EXPECT_THAT(error_of_writing(path), HasSubstr("another run writes it too"));
  {
    const FileLock lock = first.close();
    EXPECT_TRUE(is_locked(path));
    EXPECT_THAT(error_of_writing(path), HasSubstr("another run writes it too"));
    EXPECT_EQ(check_seal(path).state, State::whole);
  }
  EXPECT_FALSE(is_locked(path));
  EXPECT_EQ(error_of_writing(path), "no error");
}

}  // namespace
}  // namespace furrow::test::sealed_file_test

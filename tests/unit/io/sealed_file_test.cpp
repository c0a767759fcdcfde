// SPDX-License-Identifier: GPL-2.0-or-later
// Whatever happens to a sealed file is noticed: cut at any length, a bit flipped anywhere, foreign.
#include "io/sealed_file.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "io/replace_file.h"
#include "scratch.h"

namespace furrow::test {
namespace {

using State = SealCheck::State;
using ::testing::HasSubstr;

TEST(SealedFile, IsWholeAndBeginsWithWhatWasWritten) {
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

TEST(SealedFile, NotClosedLeavesTheFormerFile) {
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

TEST(SealedFile, EveryCutAndEveryFlippedBitIsNoticed) {
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

TEST(SealedFile, SaysWhyAFileCannotBeRead) {
  const Scratch scratch;
  EXPECT_THAT(check_seal(scratch.path("missing")).problem, HasSubstr("No such file"));
  EXPECT_EQ(check_seal(scratch.path(".")).problem, "is a folder");
  EXPECT_EQ(check_seal("/dev/null").problem, "is no regular file");
  write_text_file(scratch.path("empty"), "");
  EXPECT_EQ(check_seal(scratch.path("empty")).problem, "is empty");
}

/// /dev/full gives "No space left on device" to every write.
TEST(SealedFile, FailuresNameTheFileAndTheReason) {
  const Scratch scratch;
  const auto message = [](const std::string& path) -> std::string {
    try {
      write_sealed_text(path, "numbers");
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  const std::string full = scratch.path("full.restart");
  std::filesystem::create_symlink("/dev/full", full + ".part");
  EXPECT_THAT(message(full), HasSubstr("full.restart' is not written"));
  std::filesystem::create_symlink("/dev/full", full + ".part");
  EXPECT_THAT(message(full), HasSubstr("No space left on device"));
  EXPECT_FALSE(std::filesystem::exists(full));
  EXPECT_THAT(message("/proc/nothing/a.restart"), HasSubstr("its folder '/proc/nothing'"));
  std::filesystem::create_directory(scratch.path("folder"));
  EXPECT_THAT(message(scratch.path("folder")), HasSubstr("Is a directory"));
}

}  // namespace
}  // namespace furrow::test

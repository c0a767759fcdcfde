// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/formats/input_text.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include "furrow/io/files/replace_file.h"
#include "scratch.h"
#include "tests/support/error_of.h"

namespace furrow::input_text_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;
using namespace std::string_literals;

TEST(InputText, TextIsReadUnchanged) {
  const Scratch scratch;
  for (const std::string& text : {""s, "a: 1\n"s, "ü € 𝄞\r\n\tend"s, "\xEF\xBF\xBD\xC2\x80"s}) {
    write_text_file(scratch.path("a"), text);
    EXPECT_EQ(read_input_text(scratch.path("a"), "a file", 100), text);
  }
  write_text_file(scratch.path("a"),
                  "\xEF\xBB\xBF"
                  "a: 1\n");
  EXPECT_EQ(read_input_text(scratch.path("a"), "a file", 100), "a: 1\n");
}

TEST(InputText, BinaryContentIsRefusedWithTheLine) {
  const Scratch scratch;
  const std::pair<std::string, std::string> cases[] = {
      {"a: 1\nb: \xE4\n",
       "a, line 2 has the byte 0xE4, which is not UTF-8; allowed: a file of text "
       "in UTF-8; save it as UTF-8"},
      {"\xFF\xFE"
       "a\0:\0"s,
       "line 1 has the byte 0xFF, which is not UTF-8"},
      {"a: 1\n\nb: \0\n"s, "line 3 has the byte 0x00, which is no text"},
      {"a: \x1B[2J", "line 1 has the byte 0x1B, which is no text"},
      {"\xC0\x80", "0xC0, which is not UTF-8"},          // overlong
      {"\xE0\x80\x80", "0xE0, which is not UTF-8"},      // overlong
      {"\xED\xA0\x80", "0xED, which is not UTF-8"},      // surrogate
      {"\xF4\x90\x80\x80", "0xF4, which is not UTF-8"},  // beyond U+10FFFF
      {"\xE2\x82", "0xE2, which is not UTF-8"},          // cut off
      {"\x80", "0x80, which is not UTF-8"},
      {std::string(101, 'a'), "has 101 bytes; allowed: a file of at most 100 bytes"}};
  for (const auto& [text, message] : cases) {
    write_text_file(scratch.path("a"), text);
    EXPECT_THAT(error_of([&] { read_input_text(scratch.path("a"), "a file", 100); }),
                HasSubstr(message));
  }
}

TEST(InputText, MissingFileOrFolderIsRefusedByName) {
  const Scratch scratch;
  const auto refusal = [](const std::string& path) {
    return error_of([&] { read_input_text(path, "a file", 100); });
  };
  EXPECT_THAT(refusal(scratch.path("absent")), HasSubstr("absent does not exist; allowed: a file"));
  EXPECT_THAT(refusal(""), HasSubstr("does not exist"));
  EXPECT_THAT(refusal(scratch.folder()), HasSubstr("is a folder; allowed: a file"));
  EXPECT_THAT(refusal("/dev/null"), HasSubstr("is no regular file"));
  EXPECT_THAT(refusal(scratch.path(std::string(5000, 'a'))), HasSubstr("cannot be opened"));
  write_text_file(scratch.path("locked"), "a");
  std::filesystem::permissions(scratch.path("locked"), std::filesystem::perms::none);
  if (access(scratch.path("locked").c_str(), R_OK) != 0) {  // root may read everything
    EXPECT_THAT(refusal(scratch.path("locked")),
                HasSubstr("locked cannot be opened (Permission denied)"));
  }
}

}  // namespace
}  // namespace furrow::input_text_test

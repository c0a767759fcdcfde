// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/files/replace_file.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <functional>

#include "furrow/io/formats/hdf5_file.h"
#include "furrow/io/results/history_file.h"
#include "furrow/io/formats/vtk_file.h"
#include "scratch.h"
#include "tests/support/error_of.h"

namespace furrow::replace_file_test {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using ::testing::HasSubstr;

TEST(ReplaceFile, WritersReplaceALinkAtTheTemporaryName) {
  struct Writer {
    std::string file, part;
    std::function<void(const std::string&)> write;
  };
  Surface triangle;
  triangle.triangles = {{0, 1, 2}};
  triangle.resize(3);
  triangle.x << 0, 1, 0, 0, 0, 1, 0, 0, 0;
  const std::vector<Channel> channels = {{"time", "s", ""}};
  const Writer writers[] = {
      {"a.csv", "a.part.csv", [](const std::string& path) { write_text_file(path, "text"); }},
      {"a.vtp", "a.part.vtp", [&](const std::string& path) { write_vtp(path, triangle); }},
      {"new.h5", "new.part.h5",
       [&](const std::string& path) { HistoryFile::create(path, channels, {}); }},
      {"flushed.h5", "flushed.part.h5",
       [&](const std::string& path) {
         HistoryFile file = HistoryFile::create(path, channels, {});
         const std::string part = fs::path(path).replace_extension("part.h5");
         fs::create_symlink(fs::path(path).parent_path() / "notes", part);
         file.append({0.5});
         file.flush();
         EXPECT_EQ(read_history(path).size(), 1u);
       }},
      {"direct.h5", "direct.h5",
       [](const std::string& path) { Hdf5File(path, Hdf5File::Mode::create).close(); }}};
  for (const Writer& writer : writers) {
    const Scratch scratch;
    write_text_file(scratch.path("notes"), "of the user");
    fs::create_symlink(scratch.path("notes"), scratch.path(writer.part));
    writer.write(scratch.path(writer.file));
    EXPECT_EQ(read_text_file(scratch.path("notes")), "of the user") << writer.file;
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(scratch.path(writer.file)))) << writer.file;
    EXPECT_GT(fs::file_size(scratch.path(writer.file)), 0u) << writer.file;
    EXPECT_EQ(fs::exists(fs::symlink_status(scratch.path(writer.part))), writer.file == writer.part)
        << writer.file;
  }
}

TEST(ReplaceFile, ErrorsNameTheFileAndTheCause) {
  const Scratch scratch;
  EXPECT_THAT(error_of([&] { write_text_file(scratch.path("no/such.csv"), ""); }),
              HasSubstr("no/such.csv: cannot be written (No such file or directory)"));
  fs::create_directory(scratch.path("a.part.csv"));
  EXPECT_THAT(error_of([&] { write_text_file(scratch.path("a.csv"), ""); }),
              HasSubstr("a.csv: cannot be written (File exists)"));
}

}  // namespace
}  // namespace furrow::replace_file_test

// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/formats/hdf5_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

#include "furrow/core/error.h"
#include "furrow/io/files/replace_file.h"
#include "scratch.h"
#include "tests/support/error_of.h"

namespace furrow::hdf5_file_test {
namespace {

using test::error_of;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Mode = Hdf5File::Mode;

TEST(Hdf5File, KeepsNumbersTextsAndAttributes) {
  const Scratch scratch;
  const std::string path = scratch.path("all.h5");
  Matrix3X columns(3, 2);
  columns << 1, 4, 2, 5, 3, 6;
  const std::string long_text(100000, 'x');  // an attribute could not hold it
  {
    Hdf5File file(path, Mode::create);
    file.write("/group/deep/numbers", std::vector<double>{1.5, -2e-300, std::nan("")});
    file.write("/group/ids", std::vector<std::int64_t>{1, std::int64_t(1) << 60});
    file.write("/group/none", std::vector<double>{});
    file.write("/x", columns);
    file.write("/triangles", std::vector<Vector3i>{{0, 1, 2}, {2, 1, 3}});
    file.write("/text", long_text);
    file.set_attribute("/group", "title", "sand, 10°");
    file.set_attribute("/group", "empty", "");
    file.set_attribute("/x", "scale", 1.0 / 3.0);
    file.close();
  }
  const Hdf5File file(path, Mode::read);
  const std::vector<double> numbers = file.read_numbers("/group/deep/numbers");
  ASSERT_EQ(numbers.size(), 3u);
  EXPECT_EQ(numbers[0], 1.5);
  EXPECT_EQ(numbers[1], -2e-300);
  EXPECT_TRUE(std::isnan(numbers[2]));
  EXPECT_THAT(file.read_integers("/group/ids"), ElementsAre(1, std::int64_t(1) << 60));
  EXPECT_TRUE(file.read_numbers("/group/none").empty());
  EXPECT_EQ(file.read_columns("/x"), columns);
  EXPECT_THAT(file.read_triples("/triangles"), ElementsAre(Vector3i(0, 1, 2), Vector3i(2, 1, 3)));
  EXPECT_EQ(file.read_text("/text"), long_text);
  EXPECT_EQ(file.text_attribute("/group", "title"), "sand, 10°");
  EXPECT_EQ(file.text_attribute("/group", "empty"), "");
  EXPECT_EQ(file.number_attribute("/x", "scale"), 1.0 / 3.0);
  EXPECT_THAT(file.attributes("/group"), ElementsAre("empty", "title"));
  EXPECT_TRUE(file.has_attribute("/x", "scale"));
  EXPECT_FALSE(file.has_attribute("/x", "unit"));
  EXPECT_TRUE(file.exists("/group/deep/numbers"));
  EXPECT_FALSE(file.exists("/group/shallow/numbers"));
}

/// Every number of a file has a checksum: one changed bit is an error, never another number.
TEST(Hdf5File, ChangedNumberIsRefused) {
  const Scratch scratch;
  const std::string path = scratch.path("numbers.h5");
  const double mark = 1234.5678;
  {
    Hdf5File file(path, Mode::create);
    file.write("/fixed", std::vector<double>(100, mark));
    file.create_growing("/growing");
    file.append("/growing", std::vector<double>(100, mark));
    file.close();
  }
  std::ifstream in(path, std::ios::binary);
  const std::string intact{std::istreambuf_iterator<char>(in), {}};
  std::string number(sizeof mark, '\0');
  std::memcpy(number.data(), &mark, sizeof mark);
  int refused = 0;
  for (std::size_t at = intact.find(number); at != std::string::npos;
       at = intact.find(number, at + 50 * sizeof mark)) {
    std::string damaged = intact;
    damaged[at] ^= 1;
    std::ofstream(path, std::ios::binary) << damaged;
    const Hdf5File file(path, Mode::read);
    for (const char* dataset : {"/fixed", "/growing"}) {
      try {
        for (const double value : file.read_numbers(dataset)) ASSERT_EQ(value, mark);
      } catch (const Error&) {
        ++refused;
      }
    }
  }
  EXPECT_GE(refused, 4);
}

TEST(Hdf5File, ReplacesDatasetsAndAttributes) {
  const Scratch scratch;
  Hdf5File file(scratch.path("replace.h5"), Mode::create);
  file.write("/a", std::vector<double>{1, 2, 3});
  file.write("/a", std::vector<double>{4});
  file.set_attribute("/a", "unit", "m");
  file.set_attribute("/a", "unit", "kilometre");
  EXPECT_THAT(file.read_numbers("/a"), ElementsAre(4));
  EXPECT_EQ(file.text_attribute("/a", "unit"), "kilometre");
}

TEST(Hdf5File, GrowsAndShrinksAcrossChunks) {
  const Scratch scratch;
  Hdf5File file(scratch.path("grow.h5"), Mode::create);
  file.create_group("/history");
  for (const char* name : {"/history/time", "/history/load", "/history/angle"})
    file.create_growing(name, 4);
  std::vector<double> expected;
  for (int i = 0; i < 5; ++i) {
    file.append("/history/time", {3.0 * i, 3.0 * i + 1.0, 3.0 * i + 2.0});
    for (int j = 0; j < 3; ++j) expected.push_back(3.0 * i + j);
  }
  EXPECT_EQ(file.read_numbers("/history/time"), expected);
  file.truncate("/history/time", 6);
  file.append("/history/time", {-1.0});
  EXPECT_THAT(file.read_numbers("/history/time"), ElementsAre(0, 1, 2, 3, 4, 5, -1));
  EXPECT_EQ(file.length("/history/time"), 7u);
  EXPECT_EQ(file.length("/history/load"), 0u);
  // in the order they were made
  EXPECT_THAT(file.members("/history"), ElementsAre("time", "load", "angle"));
}

/// HDF5 notices changes in its internal records by their checksums, so a changed byte leads to a
/// refusal or to other numbers, and to nothing else.
TEST(Hdf5File, AlteredByteGivesAnErrorOrAReadableFile) {
  const Scratch scratch;
  const std::string path = scratch.path("whole.h5"), altered = scratch.path("altered.h5");
  {
    Hdf5File file(path, Mode::create);
    file.create_growing("/history/time", 4);
    file.append("/history/time", {1, 2, 3, 4, 5});
    file.set_attribute("/history/time", "unit", "s");
    file.write("/text", std::string("some words"));
    file.write("/x", Matrix3X::Zero(3, 4));
  }
  const std::string whole = read_text_file(path);
  int refused = 0;
  for (std::size_t n = 0; n < whole.size(); ++n) {
    std::string bytes = whole;
    bytes[n] = static_cast<char>(bytes[n] ^ (1 << n % 8));
    write_text_file(altered, bytes);
    refused += "no error" != error_of([&] {
                 const Hdf5File file(altered, Mode::read);
                 for (const std::string& name : file.members("/history"))
                   file.read_numbers("/history/" + name);
                 file.text_attribute("/history/time", "unit");
                 file.read_text("/text");
                 file.read_columns("/x");
               });
  }
  EXPECT_GT(refused, 200) << "of " << whole.size() << " bytes";
}

TEST(Hdf5File, ErrorsNameFileObjectAndCause) {
  const Scratch scratch;
  const std::string missing = scratch.path("missing.h5"), text = scratch.path("text.h5"),
                    good = scratch.path("good.h5");
  EXPECT_THAT(error_of([&] { Hdf5File(missing, Mode::read); }),
              AllOf(HasSubstr(missing + ": cannot open as an HDF5 file"),
                    HasSubstr("No such file or directory")));
  std::ofstream(text) << "time sinkage\n";
  EXPECT_THAT(error_of([&] { Hdf5File(text, Mode::read); }),
              HasSubstr(text + ": cannot open as an HDF5 file"));
  EXPECT_THAT(error_of([&] { Hdf5File(scratch.path("no/such/folder.h5"), Mode::create); }),
              HasSubstr("cannot create the file"));

  Hdf5File file(good, Mode::create);
  file.write("/x", Matrix3X::Zero(3, 4));
  file.set_attribute("/x", "number", 1.0);
  EXPECT_THAT(error_of([&] { file.read_numbers("/none"); }),
              HasSubstr(good + ": cannot open dataset '/none'"));
  EXPECT_THAT(error_of([&] { file.read_numbers("/x"); }),
              HasSubstr(good + ": dataset '/x' must be one-dimensional"));
  EXPECT_THAT(error_of([&] { file.text_attribute("/x", "unit"); }),
              HasSubstr("cannot read attribute unit of '/x'"));
  EXPECT_THAT(error_of([&] { file.text_attribute("/x", "number"); }),
              HasSubstr("'number' of '/x' is not a text"));
  EXPECT_THAT(error_of([&] { file.append("/x", {1.0}); }),
              HasSubstr("dataset '/x' must be one-dimensional"));
}

}  // namespace
}  // namespace furrow::hdf5_file_test

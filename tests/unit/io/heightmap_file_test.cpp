// SPDX-License-Identifier: GPL-2.0-or-later
// Heightmaps: both formats give the same surface, and faulty files are refused with their line.
#include "furrow/io/formats/heightmap_file.h"
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <cmath>
#include <functional>

#include "furrow/core/error.h"
#include "scratch.h"
#include "tests/support/error_of.h"

namespace furrow::heightmap_file_test {
namespace {

using test::error_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

struct HeightmapFile : ::testing::Test {
  std::string write(const std::string& text) const { return scratch.file("map", text); }
  std::string refusal(const std::string& text) const {
    const std::string path = write(text);
    return error_of<InputError>([&] { read_heightmap(path); });
  }
  Scratch scratch;
};

/// A plane over a regular grid, the north first.
constexpr const char* grid =
    "ncols 3\nnrows 2\nxllcorner 9.75\nyllcorner 19.75\ncellsize 0.5\nNODATA_value -9999\n"
    "1.41 1.46 1.51\n1.40 1.45 1.50\n";
constexpr const char* points =
    "# x y z\n10 20 1.40\n10.5 20 1.45\n11 20 1.50\n11 20.5 1.51\n10, 20.5, 1.41\n10.5 20.5 1.46\n";

TEST_F(HeightmapFile, GridAndPointsInAnyOrderGiveTheSameBilinearSurface) {
  for (const char* text : {grid, points}) {
    const Heightmap map = read_heightmap(write(text), Vector3(10.0, 20.0, 1.4));
    for (const Vector2& place : {Vector2(0.0, 0.0), Vector2(0.3, 0.1), Vector2(1.0, 0.5)})
      EXPECT_NEAR(map.height(place.x(), place.y()), 0.1 * place.x() + 0.02 * place.y(), 1e-12);
    EXPECT_NEAR(map.height(-0.2, 0.0), 0.0, 1e-12);  // in the first cell
    EXPECT_THAT(error_of<InputError>([&] { map.height(1.3, 0.0); }),
                AllOf(HasSubstr("does not cover x = 1.3"), HasSubstr("heightmap_origin")));
  }
}

TEST_F(HeightmapFile, CornerAndCentreOfACellAreDistinguished) {
  const std::string text =
      with(with(grid, "xllcorner 9.75", "xllcenter 10.0"), "yllcorner 19.75", "yllcenter 20.0");
  EXPECT_EQ(read_heightmap(write(text)).lower, read_heightmap(write(grid)).lower);
}

TEST_F(HeightmapFile, FaultyFilesAreRefusedWithTheirLine) {
  const auto changed = [](const std::string& from, const std::string& to) {
    return with(grid, from, to);
  };
  EXPECT_THAT(refusal(changed("1.46", "-9999")),
              AllOf(HasSubstr("line 7"), HasSubstr("no height")));
  EXPECT_THAT(refusal(changed("1.40", "nan")), AllOf(HasSubstr("line 8"), HasSubstr("no height")));
  EXPECT_THAT(refusal(changed("1.45", "1,45x")), HasSubstr("line 8"));
  EXPECT_THAT(refusal(changed(" 1.50", "")), HasSubstr("has 5 heights"));
  EXPECT_THAT(refusal(changed("1.50", "1.50 1.6")), HasSubstr("more heights"));
  EXPECT_THAT(refusal(changed("cellsize 0.5\n", "")), HasSubstr("no 'cellsize'"));
  EXPECT_THAT(refusal(changed("ncols 3", "ncols 3e9")), HasSubstr("columns"));
  for (const char* wrong : {"inf", "nan", "1e300"}) {
    EXPECT_THAT(refusal(changed("9.75", wrong)), HasSubstr("corner or a cellsize"));
    EXPECT_THAT(refusal(changed("cellsize 0.5", std::string("cellsize ") + wrong)),
                HasSubstr("corner or a cellsize"));
    EXPECT_THAT(refusal(std::string("0 0 1\n") + wrong + " 0 1\n"),
                AllOf(HasSubstr("line 2"), HasSubstr("up to 1e+09 m")));
  }
  EXPECT_THAT(refusal("10 20 1\n10.5 20 1\n10 20.5 1\n"), HasSubstr("no height at x = 10.5"));
  EXPECT_THAT(refusal("0 0 1\n1 0 1\n0 1 1\n1.3 1 1\n"), HasSubstr("regular grid"));
  EXPECT_THAT(refusal("0 0 1\n1 0 1\n0 0 2\n1 1 1\n0 1 1\n"),
              AllOf(HasSubstr("line 3"), HasSubstr("repeats a point")));
  EXPECT_THAT(refusal("0 0\n"), HasSubstr("x y z"));
  EXPECT_THAT(refusal(""), HasSubstr("is empty"));
  EXPECT_THAT(refusal(std::string("II*\0\x08\0\0\0", 8)), HasSubstr("gdal_translate -of AAIGrid"));
  EXPECT_THAT(error_of<InputError>([] { read_heightmap("nowhere.asc"); }),
              HasSubstr("does not exist"));
}

TEST_F(HeightmapFile, HeadingsColoursAndDecimalCommasAreRead) {
  const std::string rows = "10 20 1.40\n10.5 20 1.45\n11 20 1.50\n11 20.5 1.51\n10 20.5 1.41\n";
  const Heightmap plain = read_heightmap(write(rows + "10.5 20.5 1.46\n"));
  for (const char* text :
       {"X,Y,Z\n10,20,1.40\n10.5,20,1.45\n11,20,1.50\n11,20.5,1.51\n10,20.5,1.41\n10.5,20.5,1.46\n",
        "//Z Y[m] X R G B\n1.40 20 10 1 2 3\n1.45 20 10.5 1 2 3\n1.50 20 11 1 2 3\n1.51 20.5 11 1 "
        "2 3\n"
        "1.41 20.5 10 1 2 3\n1.46 20.5 10.5 1 2 3\n",
        "10 20 1.40 9 9 9\n10.5 20 1.45 9 9 9\n11 20 1.50 9 9 9\n11 20.5 1.51 9 9 9\n10 20.5 1.41 "
        "9 9 "
        "9\n10.5 20.5 1.46 9 9 9\n",
        "10;20;1,40\n10,5;20;1,45\n11;20;1,50\n11;20,5;1,51\n10;20,5;1,41\n10,5;20,5;1,46\n"}) {
    const Heightmap map = read_heightmap(write(text));
    EXPECT_EQ(map.heights, plain.heights) << text;
    EXPECT_EQ(map.lower, plain.lower) << text;
  }
  std::string commas = grid;
  for (char& c : commas)
    if (c == '.') c = ',';
  EXPECT_EQ(read_heightmap(write(commas)).heights, read_heightmap(write(grid)).heights);
  EXPECT_THAT(refusal("X,Y,depth\n1,2,3\n"), HasSubstr("has no heading 'z'"));
}

/// Closed form: planes are resampled without an error. The error of a wave falls with the spacing.
TEST_F(HeightmapFile, ScansOffTheGridAreResampledWithTheirError) {
  const auto scan = [&](int count, const std::function<double(double, double)>& height) {
    std::string text;
    std::uint32_t seed = 1;
    const auto jitter = [&] {
      seed = 1664525u * seed + 1013904223u;
      return 0.4 * (seed / 4294967296.0 - 0.5) / count;
    };
    for (int i = 0; i <= count; ++i)
      for (int j = 0; j <= count; ++j) {
        const double x = static_cast<double>(i) / count + jitter(),
                     y = static_cast<double>(j) / count + jitter();
        text += fmt::format("{:.17g} {:.17g} {:.17g}\n", x, y, height(x, y));
      }
    return read_heightmap(write(text));
  };
  const auto plane = [](double x, double y) { return 0.1 * x - 0.3 * y + 2.0; };
  const Heightmap flat = scan(20, plane);
  EXPECT_NEAR(flat.height(0.37, 0.61), plane(0.37, 0.61), 1e-12);
  EXPECT_THAT(flat.note, HasSubstr("441 points on no regular grid are resampled every 0.0"));
  const auto wave = [](double x, double) { return 0.01 * std::sin(2.0 * pi * x); };
  const auto error = [&](int count) {
    const Heightmap map = scan(count, wave);
    double sum = 0.0;
    for (int n = 1; n < 50; ++n)
      sum += std::pow(map.height(0.02 * n, 0.5) - wave(0.02 * n, 0.5), 2);
    return std::sqrt(sum / 49.0);
  };
  const double coarse = error(20), fine = error(40);
  EXPECT_LT(coarse, 5e-4);
  EXPECT_NEAR(coarse / fine, 4.0, 1.5);  // second order
}

/// The bytes of a picture without compression: two rows of three pixels, the lower one first.
TEST_F(HeightmapFile, PicturesGiveHeightsFromBlackToWhite) {
  const auto number = [](std::uint32_t value, int bytes) {
    std::string text;
    for (int n = 0; n < bytes; ++n, value >>= 8) text += static_cast<char>(value & 255u);
    return text;
  };
  std::string bmp = "BM" + number(54 + 24, 4) + number(0, 4) + number(54, 4) + number(40, 4) +
                    number(3, 4) + number(2, 4) + number(1, 2) + number(24, 2) + number(0, 4) +
                    number(24, 4) + number(0, 16);
  for (const int grey : {0, 51, 102, -1, 153, 204, 255, -1})
    bmp += grey < 0 ? number(0, 3) : number(static_cast<std::uint32_t>(grey) * 0x010101u, 3);
  const std::string path = scratch.file("map.bmp", bmp);
  const Heightmap map = read_heightmap(path, Vector3::Zero(), PictureSize(6.0, 2.0, -0.5, 0.5));
  ASSERT_EQ(map.columns, 3);
  ASSERT_EQ(map.rows, 2);
  EXPECT_NEAR(map.height(-2.0, -0.5), -0.5, 1e-12);
  EXPECT_NEAR(map.height(2.0, 0.5), 0.5, 1e-12);
  EXPECT_NEAR(map.height(0.0, 0.0), 0.5 * (51 + 204) / 255.0 - 0.5, 1e-12);
  EXPECT_THAT(error_of<InputError>([&] { read_heightmap(path); }),
              HasSubstr("is a picture, which has no lengths; allowed: the keyword"));
  EXPECT_THAT(error_of<InputError>(
                  [&] { read_heightmap(write(grid), Vector3::Zero(), PictureSize(1, 1, 0, 1)); }),
              HasSubstr("is no picture"));
  const std::string broken = scratch.file("map.png", "text");
  EXPECT_THAT(error_of<InputError>(
                  [&] { read_heightmap(broken, Vector3::Zero(), PictureSize(1, 1, 0, 1)); }),
              HasSubstr("is no picture"));
}

/// 49 million nodes would take 392 MB.
TEST_F(HeightmapFile, ShortFileWithALargeHeaderIsRefusedWithoutAllocation) {
  const std::string header = "xllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n";
  const auto peak = [] {
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);  // [bytes]
  };
  const double before = peak();
  EXPECT_THAT(refusal("ncols 7000\nnrows 7000\n" + header),
              AllOf(HasSubstr("has 63 bytes"), HasSubstr("announces 49000000 heights")));
  EXPECT_THAT(refusal("0 0 1\n7000 7000 1\n1 1 1\n"),
              HasSubstr("has 3 points for 49014001 nodes of a regular grid"));
  EXPECT_LT(peak() - before, 40e6);
}

/// A digit and a blank each: the shortest file that has all heights.
TEST_F(HeightmapFile, HeightsOfOneDigitAreRead) {
  const Heightmap map = read_heightmap(
      write("nrows 1\nncols 70\nxllcorner 0\nyllcorner 0\ncellsize 1\n" + std::string("1") + [] {
        std::string more;
        for (int n = 1; n < 70; ++n) more += " 2";
        return more;
      }()));
  EXPECT_EQ(map.heights.back(), 2.0);
}

}  // namespace
}  // namespace furrow::heightmap_file_test

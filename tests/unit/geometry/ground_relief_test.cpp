// SPDX-License-Identifier: GPL-2.0-or-later
// Surfaces that are not flat: the shapes, and the spectrum of a random profile.
#include "furrow/geometry/ground_relief.h"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "tests/support/error_of.h"
#include "tests/support/words.h"

namespace furrow::ground_relief_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

GroundRelief relief_of(const std::string& line) {
  Schema schema("fix terrain");
  declare_relief(schema);
  return relief_from(schema.read(test::words(line)), {});
}

TEST(GroundRelief, HeightsOfSeveralShapesAddUp) {
  EXPECT_TRUE(relief_of("").flat());
  EXPECT_EQ(relief_of("").height(3.0, 4.0), 0.0);
  const GroundRelief sine = relief_of("washboard 0.8 0.03 flat_until 0.5");
  EXPECT_EQ(sine.height(0.4, 0.0), 0.0);
  EXPECT_NEAR(sine.height(0.7, 9.0), 0.03, 1e-15);
  EXPECT_NEAR(sine.height(0.5 + 0.8 * 7.0 + 0.6, 0.0), -0.03, 1e-14);
  const GroundRelief step = relief_of("trapezoid 1 0.1 0.2 0.6");
  EXPECT_NEAR(step.height(1.1, 0.0), 0.1, 1e-15);
  EXPECT_NEAR(step.height(1.2, 0.0), 0.05, 1e-15);
  EXPECT_EQ(step.height(1.31, 0.0), 0.0);
  const GroundRelief log = relief_of("half_cylinder 1 0.1");
  EXPECT_NEAR(log.height(1.06, 0.0), 0.08, 1e-15);
  EXPECT_EQ(log.height(0.89, 0.0), 0.0);
  const GroundRelief both = relief_of("half_cylinder 1 0.1 washboard 0.8 0.03");
  EXPECT_NEAR(both.height(1.0, 0.0), 0.1 + 0.03, 1e-15);
}

/// By a Hann window and Fourier sums over 400 m, mean of several seeds: in each octave the power
/// per frequency is that of ISO 8608, G(n0) (n/n0)^-2.
TEST(GroundRelief, PeriodogramOfARandomProfileHasTheSpectrumOfIso8608) {
  constexpr double density = 256e-6, length = 400.0, step = 0.1, n0 = 0.1;
  constexpr int points = 4000, seeds = 12;
  const std::vector<double> octaves = {0.02, 0.04, 0.08, 0.16, 0.32, 0.64, 1.28};  // [cycles/m]
  std::vector<double> measured(octaves.size(), 0.0), expected(octaves.size(), 0.0);
  for (int seed = 1; seed <= seeds; ++seed) {
    const GroundRelief relief = relief_of(fmt::format("roughness 256e-6 roughness_seed {}", seed));
    VectorX heights(points);
    for (int i = 0; i < points; ++i)
      heights[i] = (1.0 - std::cos(2.0 * pi * i / points)) * relief.height(i * step, 0.0);
    for (std::size_t k = 0; k < octaves.size(); ++k) {
      const int first = static_cast<int>(octaves[k] * length);
      for (int bin = first; bin < 2 * first; bin += std::max(1, first / 16)) {
        const double n = bin / length;
        double cosine = 0.0, sine = 0.0;
        for (int i = 0; i < points; ++i) {
          cosine += heights[i] * std::cos(2.0 * pi * n * i * step);
          sine += heights[i] * std::sin(2.0 * pi * n * i * step);
        }
        // the window 1 - cos has the mean square 1.5
        measured[k] += 2.0 * step * (cosine * cosine + sine * sine) / (1.5 * points);
        expected[k] += density * std::pow(n / n0, -2.0);
      }
    }
  }
  for (std::size_t k = 0; k < octaves.size(); ++k)
    EXPECT_NEAR(measured[k] / expected[k], 1.0, 0.25) << octaves[k];
}

/// A map in millimetres, with the heights of its site, or with heights in centimetres
TEST(GroundRelief, ImpossibleHeightmapIsRefused) {
  const auto said = [](double spacing, double level, double amplitude) {
    auto map = std::make_shared<Heightmap>();
    map->name = "map";
    map->columns = map->rows = 100;
    map->spacing = {spacing, spacing};
    map->lower = -50.0 * map->spacing;
    for (int n = 0; n < 10000; ++n) map->heights.push_back(level + (n % 2 ? amplitude : 0.0));
    ReliefParameters parameters;
    parameters.heightmap = map;
    const GroundRelief relief(parameters, "ground");
    return error_of<InputError>([&] { relief.check_map({-2.0, -1.0}, {2.0, 1.0}); });
  };
  EXPECT_EQ(said(0.1, 0.0, 0.05), "no error");
  EXPECT_THAT(said(100.0, 0.0, 50.0), HasSubstr("has a height every 100 m"));
  EXPECT_THAT(said(0.1, 412.0, 0.05), HasSubstr("has heights of 412 m"));
  EXPECT_THAT(said(0.1, 0.0, 5.0), HasSubstr("climbs and falls"));
}

/// The table of ISO 8608, in 1e-6 m^3.
TEST(GroundRelief, RoadClassesHaveTheMeanDensitiesOfIso8608) {
  const std::vector<std::pair<char, double>> table = {{'A', 16},    {'B', 64},    {'C', 256},
                                                      {'D', 1024},  {'E', 4096},  {'F', 16384},
                                                      {'G', 65536}, {'H', 262144}};
  for (const auto& [letter, density] : table) {
    EXPECT_DOUBLE_EQ(Roughness::mean_density(letter), 1e-6 * density);
    const GroundRelief by_class = relief_of(fmt::format("road_class {}", letter)),
                       by_density = relief_of(fmt::format("roughness {}e-6", density));
    EXPECT_FALSE(by_class.flat());
    EXPECT_NEAR(by_class.height(1.7, 0.0), by_density.height(1.7, 0.0), 1e-12);
  }
}

/// The integral of G(n0) (n/n0)^-2 from n1 to n2 is the mean square, G(n0) n0^2 (1/n1 - 1/n2).
TEST(GroundRelief, RoadClassHasTheRmsOfItsSpectrum) {
  constexpr double n1 = 0.05, n2 = 2.0, n0 = 0.1, length = 4000.0, step = 0.1;
  for (const auto& [letter, density] : {std::pair("A", 16e-6), std::pair("E", 4096e-6)}) {
    const GroundRelief relief =
        relief_of(fmt::format("road_class {} roughness_band 0.05 2 roughness_seed 5", letter));
    double squares = 0.0;
    for (int i = 0; i < static_cast<int>(length / step); ++i)
      squares += std::pow(relief.height(i * step, 0.0), 2);
    const double rms = std::sqrt(squares * step / length);
    EXPECT_NEAR(rms, std::sqrt(density * n0 * n0 * (1.0 / n1 - 1.0 / n2)), 0.03 * rms) << letter;
  }
}

TEST(GroundRelief, HeightDependsOnSeedAndPlaceAlone) {
  const std::string line = "roughness 1e-3 roughness_seed 7";
  const GroundRelief one = relief_of(line), same = relief_of(line),
                     other = relief_of("roughness 1e-3 roughness_seed 8");
  EXPECT_EQ(one.height(123.4, 0.0), same.height(123.4, 5.0));
  EXPECT_NE(one.height(123.4, 0.0), other.height(123.4, 0.0));
  const GroundRelief later = relief_of("roughness 1e-3 flat_until 2");
  EXPECT_EQ(later.height(2.0, 0.0), 0.0);
  EXPECT_LT(std::abs(later.height(2.0 + 1e-6, 0.0)), 1e-6);  // continuous
}

TEST(GroundRelief, ImpossibleShapesAreRefusedWithTheirKeyword) {
  const auto refusal = [](const std::string& line) {
    return error_of<InputError>([&] { relief_of(line); });
  };
  EXPECT_THAT(refusal("washboard 0 0.1"), HasSubstr("keyword 'washboard'"));
  EXPECT_THAT(refusal("trapezoid 0 0.1 0.5 0.5"), HasSubstr("keyword 'trapezoid'"));
  EXPECT_THAT(refusal("half_cylinder 0 -1"), HasSubstr("keyword 'half_cylinder'"));
  EXPECT_THAT(refusal("roughness 1e-6 roughness_band 2 1"), HasSubstr("keyword 'roughness_band'"));
  EXPECT_THAT(refusal("flat_until 1"), HasSubstr("keyword 'flat_until'"));
  EXPECT_THAT(refusal("roughness_seed 3"), HasSubstr("without 'roughness'"));
  EXPECT_THAT(refusal("road_class C roughness 1e-6"),
              HasSubstr("keyword 'road_class' is given with 'roughness'"));
  EXPECT_THAT(refusal("road_class c"), HasSubstr("A, B, C, D, E, F, G, H"));
  EXPECT_THAT(refusal("heightmap_origin 0 0 0"), HasSubstr("without 'heightmap'"));
}

}  // namespace
}  // namespace furrow::ground_relief_test

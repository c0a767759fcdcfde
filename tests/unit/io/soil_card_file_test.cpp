// SPDX-License-Identifier: GPL-2.0-or-later
// A soil card as furrow-post card writes it, and cards with missing or impossible values.

#include "furrow/io/inputs/soil_card_file.h"

#include <cmath>
#include <map>
#include <string>

#include <gmock/gmock.h>

#include "scratch.h"
#include "tests/support/error_of.h"

namespace furrow::soil_card_file_test {
namespace {

using ::testing::HasSubstr;

constexpr char card[] = R"(title: Soil card of my_sand
ground: my_sand.yaml
density: 1600.0
stiffness: 1.8e8
gravity: 9.80665
pressure_sinkage:
  k_c: {value: -5628.0, error: 183.0, unit: N/m^(n+1)}
  k_phi: {value: 1950915.0, error: 700.0, unit: N/m^(n+2)}
  n: {value: 1.23, error: 0.066}
  sinkage: [0.0016, 0.06]
  pressure: [6557.15, 90408.6]
shear:
  c: {value: 3695.0, error: 134.0, unit: Pa}
  phi: {value: 29.7, error: 0.6, unit: degree}
  K: {value: 0.0064, error: 0.0002, unit: m}
notes: []
)";

class SoilCardFile : public ::testing::Test {
 protected:
  std::string written(const std::string& old = "", const std::string& now = "") {
    return scratch_.file("card.yaml", with(card, old, now));
  }
  std::string refusal(const std::string& old, const std::string& now) {
    return test::error_of([&] { read_soil_card(written(old, now)); });
  }
  Scratch scratch_;
};

TEST_F(SoilCardFile, ParametersOfTheSoilAreRead) {
  const std::map<std::string, double> values = read_soil_card(written()).values;
  EXPECT_EQ(values.at("k_c"), -5628.0);
  EXPECT_EQ(values.at("k_phi"), 1950915.0);
  EXPECT_EQ(values.at("n"), 1.23);
  EXPECT_EQ(values.at("c"), 3695.0);
  EXPECT_EQ(values.at("phi"), 29.7);
  EXPECT_EQ(values.at("K"), 0.0064);
  EXPECT_EQ(values.at("stiffness"), 1.8e8);
}

TEST_F(SoilCardFile, RangeOfThePlatesIsRead) {
  const SoilCard found = read_soil_card(written());
  EXPECT_EQ(found.deepest, 0.06);
  EXPECT_EQ(found.largest_pressure, 90408.6);
  EXPECT_TRUE(std::isinf(read_soil_card(written("  sinkage: [0.0016, 0.06]\n", "")).deepest));
  EXPECT_THAT(refusal("[0.0016, 0.06]", "[0.0016, deep]"), HasSubstr("card.yaml, line 10"));
}

TEST_F(SoilCardFile, GravityOfTheTestsIsRead) {
  EXPECT_EQ(read_soil_card(written("9.80665", "1.62")).gravity, 1.62);
  EXPECT_THAT(refusal("gravity: 9.80665\n", ""),
              HasSubstr("card.yaml has no 'gravity'; allowed: the gravity of the tests, in m/s^2; "
                        "add the line 'gravity: 9.80665'"));
  EXPECT_THAT(refusal("gravity: 9.80665", "gravity: -1.62"), HasSubstr("card.yaml, line 5"));
}

TEST_F(SoilCardFile, ContactWithBodiesIsRead) {
  EXPECT_TRUE(read_soil_card(written()).contact.empty());
  const GroundContact contact =
      read_soil_card(written("notes: []",
                             "contact: {steel: {friction: 0.4, friction_range: [0.3, 0.5], "
                             "slip_length: 0.01, slip_length_range: [0, 0.02], label: measured, "
                             "source: ring}}"))
          .contact;
  EXPECT_EQ(contact.at("steel").friction, 0.4);
}

TEST_F(SoilCardFile, SingleNumberForARangeIsRefused) {
  EXPECT_THAT(refusal("sinkage: [0.0016, 0.06]", "sinkage: 0.06"),
              HasSubstr("'sinkage' is not a list of two numbers"));
}

TEST_F(SoilCardFile, RefusalsNameFileLineAndKey) {
  EXPECT_THAT(refusal("shear:", "sheer:"), HasSubstr("shear"));
  EXPECT_THAT(refusal("{value: 29.7, error: 0.6, unit: degree}", "{angle: 29.7}"),
              HasSubstr("angle"));
  EXPECT_THAT(refusal("value: 1.23", "value: -1"), HasSubstr("card.yaml, line 9"));
  EXPECT_THAT(
      refusal("  c: {value: 3695.0, error: 134.0, unit: Pa}", "  failed: the ring sank through"),
      HasSubstr("card.yaml, line 13 has no values, because the test failed: the ring sank"));
  EXPECT_THAT(refusal("stiffness: 1.8e8", "stiffness: soft"), HasSubstr("stiffness"));
}

TEST_F(SoilCardFile, PlainNumbersAndOtherUnitsAreConverted) {
  const auto value = [&](const char* old, const char* now, const char* key) {
    return read_soil_card(written(old, now)).values.at(key);
  };
  EXPECT_EQ(value("{value: 29.7, error: 0.6, unit: degree}", "29.7", "phi"), 29.7);
  EXPECT_NEAR(value("value: 29.7, error: 0.6, unit: degree", "value: 0.5, unit: rad", "phi"),
              28.6479, 1e-4);
  EXPECT_EQ(value("value: 3695.0, error: 134.0, unit: Pa", "value: 3.695, unit: kPa", "c"), 3695.0);
  EXPECT_EQ(value("value: 0.0064, error: 0.0002, unit: m", "value: 0.64, unit: cm", "K"), 0.0064);
  EXPECT_EQ(value("value: 1950915.0, error: 700.0, unit: N/m^(n+2)",
                  "value: 1950.915, unit: kN/m^(n+2)", "k_phi"),
            1950915.0);
  EXPECT_THAT(refusal("unit: degree", "unit: gon"), HasSubstr("is 'gon'; allowed: deg"));
  EXPECT_THAT(refusal("notes: []", "c_1: 0.4"), HasSubstr("c_1"));
}

/// Sample values of Project Chrono in its keys, with a comment as its files have them.
TEST_F(SoilCardFile, TerrainFileOfChronoIsReadAsACard) {
  const char json[] = R"(// terrain
{"Type": "SCM", "Soil parameters": {"Bekker Kphi": 2e6, "Bekker Kc": 0, "Bekker n exponent": 1.1,
 "Mohr cohesive limit": 0, "Mohr friction limit": 30, "Janosi shear coefficient": 0.01,
 "Elastic stiffness": 4e7, "Damping": 3e4}})";
  const auto read = [&](const std::string& text) {
    return read_soil_card(scratch_.file("scm.json", text));
  };
  const SoilCard found = read(json);
  const std::map<std::string, double> expected = {{"k_c", 0.0},       {"k_phi", 2e6},  {"n", 1.1},
                                                  {"c", 0.0},         {"phi", 30.0},   {"K", 0.01},
                                                  {"stiffness", 4e7}, {"damping", 3e4}};
  EXPECT_EQ(found.values, expected);
  EXPECT_FALSE(found.gravity);
  EXPECT_THAT(test::error_of([&] { read(with(json, "Bekker n exponent", "Bekker n")); }),
              HasSubstr("has \"Bekker n\": 1.1"));
  EXPECT_THAT(test::error_of([&] { read(with(json, "\"Bekker Kc\": 0, ", "")); }),
              HasSubstr("has no \"Bekker Kc\""));
  EXPECT_THAT(test::error_of([&] { read("{"); }), HasSubstr("is no JSON"));
}

}  // namespace
}  // namespace furrow::soil_card_file_test

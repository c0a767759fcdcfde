// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/inputs/tyre_file.h"

#include <gmock/gmock.h>

#include "furrow/io/files/replace_file.h"
#include "scratch.h"
#include "tests/support/error_of.h"

namespace furrow::tyre_file_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

const std::string inputs = FURROW_SOURCE_DIR "/inputs/tyres/";

class TyreFileTest : public ::testing::Test {
 protected:
  /// Error of the reader for the 235/75 R15 with one text replaced by another.
  std::string refusal(const std::string& from, const std::string& to) {
    const std::string text = with(read_text_file(inputs + "p235_75r15.yaml"), from, to);
    return error_of([&] { read_tyre_file(scratch_.file("tyre.yaml", text)); });
  }
  Scratch scratch_;
};

TEST_F(TyreFileTest, ShippedTyresAreRead) {
  const TyreParameters tyre = read_tyre_file(inputs + "p235_75r15.yaml");
  EXPECT_EQ(tyre.title, "P235/75 R15");
  EXPECT_EQ(tyre.sidewall.segments(), 10u);
  EXPECT_DOUBLE_EQ(tyre.sidewall.rim_angle, radians(23));
  // [Shoop2001] Table 8: 4.1261 N m along and 2.259 N m across
  const double h3 = std::pow(tyre.tread.thickness, 3);
  EXPECT_NEAR(tyre.tread.E1 * h3 / 12, 4.1261, 0.001);
  EXPECT_NEAR(tyre.tread.E2 * h3 / 12, 2.259, 0.003);
  EXPECT_NEAR(tyre.sidewall_chord()[1], (0.695 - 0.416) / 2, 1e-12);
  EXPECT_EQ(read_tyre_file(inputs + "generic_195_65r15.yaml").sidewall.segments(), 8u);
}

TEST_F(TyreFileTest, EffectiveValuesReadBackAsTheSameTyre) {
  for (const char* name : {"p235_75r15.yaml", "generic_195_65r15.yaml"}) {
    const std::string text = tyre_file_text(read_tyre_file(inputs + name));
    EXPECT_EQ(tyre_file_text(read_tyre_file(scratch_.file("back.yaml", text))), text);
    EXPECT_THAT(text, HasSubstr("[Pa] inflation pressure above atmospheric pressure"));
  }
}

TEST_F(TyreFileTest, BadFilesAreRefusedWithTheirPlace) {
  struct Case {
    std::string from, to, message;
  };
  const std::vector<Case> cases = {
      {"pressure: 241e3", "pressure: -241e3",
       "tyre.yaml, line 5: tyre, keyword 'pressure' is -241"},
      {"pressure: 241e3", "pressure: 1e9",
       "tyre.yaml, line 5: tyre, keyword 'pressure' is 1e9; allowed: a number in [0, 2000000] "
       "[Pa]"},
      {"radius: 0.3475", "radius: 347.5",
       "tread, keyword 'radius' is 347.5; allowed: a number in (0, 10] [m]"},
      {"E1: 3.62e10", "E1: 1e300",
       "keyword 'E1' is 1e300; allowed: a number in [1, 10000000000000] [Pa]"},
      {"tread:\n", "tyre:\n", "keyword 'tyre' is given twice"},
      {"sidewall:\n", "---\nsidewall:\n", "begins a second document"},
      {"pressure: 241e3", "pressure: nan", "keyword 'pressure' is nan"},
      {"bead_radius: 0.208", "rim_radius: 0.208",
       "tyre has no keyword 'rim_radius'; allowed: pressure, bead_radius"},
      {"tread:\n", "band:\n", "'band'"},
      {"nu12: 0.3 ", "nu12: 1.5 ", "tread, keyword 'nu12' is 1.5; allowed: a number in (-1, 1)"},
      {"E1: 3.62e10", "E1: 1e8", "nu12 = 0.3 makes its stiffness indefinite"},
      {"length: 0.161", "length: 0.139",
       "the sidewall is stretched past its length: bead and tread edge are 0.1396 m apart"},
      {"radius: 0.3475", "radius: 0.3975", "the sidewall is stretched past its length"},
      {"radius: 0.3475", "radius: 0.20", "lies inside the rim"},
      {"bead_spacing: 0.165", "bead_spacing: 0.30", "the rim is wider than the tyre"},
      {"radius: 0.3475", "crown: 0.2\n  radius: 0.3475", "the tread's crown is 0.2 m"},
      {", 17.54]", "]", "has 8 values of curvature for 9 of bending"},
      {", 17.54]", ", 300]", "curvature 300 1/m folds a hinge"},
      {"[1.5,  0.15,", "[1.5,  -0.15,", "keyword 'bending' is -0.15"},
      {"rim_stiffness: 50\n", "rim_stiffness: -1\n",
       "keyword 'rim_stiffness' is -1; allowed: a number in [0, 10000000]"},
      {"rim_angle: 23 ", "rim_angle: 230 ", "keyword 'rim_angle' is 230"},
  };
  for (const Case& bad : cases)
    EXPECT_THAT(refusal(bad.from, bad.to), HasSubstr(bad.message)) << bad.to;
  EXPECT_THAT(error_of([&] { read_tyre_file(scratch_.path("absent.yaml")); }),
              HasSubstr("does not exist"));
}

}  // namespace
}  // namespace furrow::tyre_file_test

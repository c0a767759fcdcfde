// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/inputs/brick_tyre_file.h"

#include <gmock/gmock.h>

#include "furrow/io/files/replace_file.h"
#include "furrow/io/inputs/tyre_file.h"
#include "scratch.h"
#include "tests/support/error_of.h"

namespace furrow::brick_tyre_file_test {
namespace {

using test::error_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string inputs = FURROW_SOURCE_DIR "/inputs/tyres/";

class BrickTyreFileTest : public ::testing::Test {
 protected:
  /// Error of the reader for the ribbed tyre with one text replaced by another.
  std::string refusal(const std::string& from, const std::string& to) {
    const std::string text = with(read_text_file(inputs + "p235_75r15_ribbed.yaml"), from, to);
    return error_of([&] { read_brick_tyre_file(scratch_.file("tyre.yaml", text)); });
  }
  Scratch scratch_;
};

TEST_F(BrickTyreFileTest, ShippedTyresAreRead) {
  const BrickTyreParameters smooth = read_brick_tyre_file(inputs + "p235_75r15_smooth.yaml");
  EXPECT_EQ(smooth.title, "P235/75 R15, smooth tread");
  EXPECT_EQ(smooth.carcass.zones.size(), 6u);
  EXPECT_NEAR(smooth.radius(), 0.737 / 2, 1e-3);  // [Shoop2001] Table 6
  EXPECT_DOUBLE_EQ(smooth.tread.rubber.law.shear, 2 * 1.109596e6);
  EXPECT_DOUBLE_EQ(smooth.tread.rubber.law.bulk, 50 * smooth.tread.rubber.law.shear);
  EXPECT_TRUE(smooth.tread.voids.empty());
  const BrickTyreParameters ribbed = read_brick_tyre_file(inputs + "p235_75r15_ribbed.yaml");
  double voids = 0.0;
  for (const TreadVoid& cut : ribbed.tread.voids) voids += cut.to - cut.from;
  EXPECT_NEAR(voids / 0.0785, 0.44, 0.03);  // [Shoop2001] Table 6: share of voids
  EXPECT_EQ(read_brick_tyre_file(inputs + "p235_75r15_lugged.yaml").tread.voids[0].pitches, 30);
}

TEST_F(BrickTyreFileTest, EffectiveValuesReadBackAsTheSameTyre) {
  for (const char* name : {"smooth", "ribbed", "lugged", "equivalent"}) {
    const std::string text =
        brick_tyre_file_text(read_brick_tyre_file(inputs + "p235_75r15_" + name + ".yaml"));
    EXPECT_EQ(brick_tyre_file_text(read_brick_tyre_file(scratch_.file("back.yaml", text))), text);
  }
}

TEST_F(BrickTyreFileTest, CordsAreReadAndWritten) {
  EXPECT_EQ(refusal("  cords: yes\n", ""), "no error");
  EXPECT_FALSE(read_brick_tyre_file(scratch_.path("tyre.yaml")).carcass.cords);
  const BrickTyreParameters tyre = read_brick_tyre_file(inputs + "p235_75r15_smooth.yaml");
  EXPECT_TRUE(tyre.carcass.cords);
  EXPECT_THAT(brick_tyre_file_text(tyre), HasSubstr("cords: yes"));
  EXPECT_THAT(refusal("cords: yes", "cords: 3"), HasSubstr("keyword 'cords' is '3'"));
}

TEST_F(BrickTyreFileTest, FilesOfTheTwoTyreModelsAreDistinguished) {
  EXPECT_TRUE(is_brick_tyre_file(inputs + "p235_75r15_smooth.yaml"));
  EXPECT_FALSE(is_brick_tyre_file(inputs + "p235_75r15.yaml"));
  EXPECT_THAT(error_of([] { read_brick_tyre_file(inputs + "p235_75r15.yaml"); }),
              HasSubstr("fix tyre/darnell read it"));
  EXPECT_THAT(error_of([] { read_tyre_file(inputs + "p235_75r15_smooth.yaml"); }),
              HasSubstr("fix tyre/brick read it"));
}

TEST_F(BrickTyreFileTest, BadFilesAreRefusedWithTheirPlace) {
  struct Case {
    std::string from, to, message;
  };
  const std::vector<Case> cases = {
      {"pressure: 241e3", "pressure: -1",
       "tyre.yaml, line 5: tyre, keyword 'pressure' is -1; allowed: a number in [0, 2000000] [Pa]"},
      {"C10: 2.408340e6", "C10: 2.4",
       "cap, keyword 'C10' is 2.4; allowed: a number in [20000, 1000000000] [Pa]"},
      {"C10: 2.408340e6", "C10: 2408.34",
       "cap, keyword 'C10' is 2408.34; allowed: a number in [20000, 1000000000] [Pa]"},
      {"C10: 2.408340e6", "C10: nan", "keyword 'C10' is nan"},
      {"density: 662.55", "density: -1", "keyword 'density' is -1"},
      {"density: 662.55", "bulk: 1e5\n  density: 662.55",
       "cap, keyword 'bulk' is 100000 Pa; allowed: more than the shear modulus 2 C10"},
      {"density: 662.55", "layers: 0\n  density: 662.55", "cap, keyword 'layers' is 0"},
      {"cap:\n", "tread:\n", "'tread'"},
      {"cap:\n", "carcass:\n", "keyword 'carcass' is given twice"},
      {"  C10: 2.408340e6                # Table 9\n", "", "cap, keyword 'C10' is missing"},
      {"axial:  [0, 0.0165,", "axial:  [0.01, 0.0165,",
       "the carcass's outline begins at axial = 0.01 m; allowed: 0, the mid-plane"},
      {"0.09834, 0.0825]", "0.09834]",
       "keyword 'radius' has 14 values; allowed: 13, as 'axial' has"},
      {"0.23355, 0.208]", "0.23355, 0.238]",
       "goes from radius 0.23355 to 0.238 m; allowed: radii that fall"},
      {"0.2048, 0.2348]", "0.2048, 0.2744]",
       "the last zone of the carcass ends at 0.2744 m, and the outline is"},
      {"zone_end:       [0.0735, 0.0840,", "zone_end:       [0.0735, 0.0700,",
       "a zone of the carcass ends at 0.07 m"},
      {"[5e6, 5e4,", "[5e6, 0,", "keyword 'stretch_along' is 0"},
      {"[5e6, 5e4,", "[5e6,",
       "keyword 'stretch_along' has 5 values; allowed: 6, as 'zone_end' has"},
      {"bending_across: [2.257,", "bending_across: [-2.257,", "keyword 'bending_across' is -2.257"},
      {"thickness: [0.021, 0.020, 0]", "thickness: [0.021, 0.020, 0.01]",
       "the tread's thickness at 0.084 m is 0.01 m; allowed: more than 0.001 m, and 0 at its end"},
      {"at:        [0, 0.0735, 0.0840]", "at:        [0, 0.0990, 0.0840]",
       "the tread's values of at do not rise"},
      {"at:        [0, 0.0735, 0.0840]", "at:        [0, 0.0735, 0.90]",
       "the tread goes from 0 to 0.9 m"},
      {"depth: [5.1e-3, 5.3e-3]", "depth: [5.1e-3]", "keyword 'depth' has 1 values; allowed: 2"},
      {"depth: [5.1e-3, 5.3e-3]", "depth: [51e-3, 5.3e-3]",
       "the void from 0.0115 to 0.0281 m is 0.051 m deep; allowed: at most"},
      {"from:  [0.0115, 0.0435]", "from:  [0.0115, 0.0235]",
       "a void begins at 0.0235 m, before the end of another at 0.0281 m"},
      {"[0.0735, 0.0840, 0.1080,", "[0.0725, 0.0840, 0.1080,",
       "the section changes at 0.0725 m and again at 0.0735 m"},
      {"to:    [0.0281, 0.0597]", "to:    [0.0101, 0.0597]",
       "the void from 0.0115 to 0.0101 m is not on the tread"},
      {"depth: [5.1e-3, 5.3e-3]", "depth: [5.1e-3, 5.3e-3]\n  pitches: [0, 2]\n  share: [1, 0.5]",
       "has 2 pitches and a share of 0.5; allowed: 0 for a groove, or 3 pitches at least"},
      {"depth: [5.1e-3, 5.3e-3]", "depth: [5.1e-3, 5.3e-3]\n  pitches: [0, 9.5]",
       "voids, keyword 'pitches' is 9.5; allowed: whole numbers"},
  };
  for (const Case& bad : cases)
    EXPECT_THAT(refusal(bad.from, bad.to), HasSubstr(bad.message)) << bad.to;
  EXPECT_THAT(error_of([&] { read_brick_tyre_file(scratch_.path("absent.yaml")); }),
              HasSubstr("does not exist"));
}

/// Few points along [Shoop2001]'s belts make a curve with a valley half way to the shoulder.
TEST_F(BrickTyreFileTest, NonConvexOutlineIsRefused) {
  BrickTyreParameters tyre = read_brick_tyre_file(inputs + "p235_75r15_smooth.yaml");
  check(tyre);
  tyre.carcass.axial = {0, 0.040, 0.0785, 0.0955, 0.1070, 0.1115, 0.1090, 0.1005, 0.0890, 0.0825};
  tyre.carcass.radius = {0.3475, 0.3469, 0.3450, 0.3340, 0.3120,
                         0.2840, 0.2580, 0.2350, 0.2170, 0.2080};
  EXPECT_THAT(
      error_of([&] { check(tyre); }),
      AllOf(HasSubstr("rises from radius 0.34679 to 0.3469 m"), HasSubstr("give more points")));
}

}  // namespace
}  // namespace furrow::brick_tyre_file_test

// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/core/options/options.h"

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "tests/support/error_of.h"
#include "tests/support/words.h"

namespace furrow::options_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

Schema wheel_schema() {
  Schema schema("fix wheel/rigid");
  schema.number("diameter", "m", Range::positive(), "outer diameter");
  schema.number("shoulder", "m", Range::non_negative(), "shoulder radius").by_default(0.0);
  schema.integer("segments", Range::closed(8, 1000), "segments").by_default("64");
  schema.choice("mode", {"towed", "slip"}, "mode").optional();
  schema.numbers("axle", 3, "m", Range::any(), "axle centre")
      .by_default(std::vector<double>{0, 0, 0});
  schema.numbers("table", 0, "Pa", Range::any(), "a list").optional();
  return schema;
}

std::string message_of(const std::string& line) {
  return error_of<InputError>([&] { wheel_schema().read(test::words(line)); });
}

TEST(Options, ReadsGivenValuesAndDefaults) {
  const Options options =
      wheel_schema().read(test::words("axle 1 -2 3e-1 diameter 0.74 table 1 2 mode slip"));
  EXPECT_DOUBLE_EQ(options.number("diameter"), 0.74);
  EXPECT_DOUBLE_EQ(options.number("shoulder"), 0.0);
  EXPECT_EQ(options.integer("segments"), 64);
  EXPECT_EQ(options.text("mode"), "slip");
  EXPECT_EQ(options.numbers("axle"), (std::vector<double>{1, -2, 0.3}));
  EXPECT_EQ(options.numbers("table"), (std::vector<double>{1, 2}));
  EXPECT_FALSE(options.given("shoulder"));
  EXPECT_TRUE(options.has("shoulder"));
  EXPECT_EQ(options.effective().size(), 6u);
}

/// Once for a list, never for a default, and only in the unit of the table.
TEST(Options, ValueOutsideTheUsualRangeIsWarnedOf) {
  Schema schema("law made");
  schema.number("density", "kg/m3", Range::positive(), "density").by_default(1.0);
  schema.numbers("rho", 0, "kg/m3", Range::positive(), "densities").optional();
  schema.number("c", "Pa", Range::non_negative(), "cohesion").optional();
  schema.number("E", "kPa", Range::positive(), "modulus in another unit").optional();
  const auto warnings = [&](const char* line) { return schema.read(test::words(line)).warnings(); };
  EXPECT_THAT(warnings("rho 40 3000 c 0 E 1"), ::testing::IsEmpty());
  EXPECT_THAT(
      warnings("density 0.3"),
      ::testing::ElementsAre("law made, keyword 'density' is 0.3 kg/m3; usual is 40 to 3000 "
                             "kg/m3; give SI units: g/cm3 times 1000, kN/m3 times 102"));
  EXPECT_THAT(warnings("rho 200 0.3 0.4 c 5"),
              ::testing::ElementsAre(HasSubstr("'rho' is 0.3 kg/m3"),
                                     HasSubstr("'c' is 5 Pa; usual is 20 to 5e+06 Pa, or 0; ")));
  const std::vector<Entry> file = {{"density", {"2000"}, ""}, {"c", {"5"}, "made.yaml, line 3"}};
  EXPECT_THAT(
      schema.read(file).warnings(),
      ::testing::ElementsAre(HasSubstr("made.yaml, line 3: law made, keyword 'c' is 5 Pa")));
}

TEST(Options, RefusesWithKeywordAllowedAndRemedy) {
  EXPECT_THAT(message_of("diametre 1"),
              HasSubstr("no keyword 'diametre'; allowed: diameter, shoulder"));
  EXPECT_THAT(message_of("diametre 1"), HasSubstr("did you mean 'diameter'?"));
  EXPECT_THAT(message_of("diameter -1"),
              HasSubstr("keyword 'diameter' is -1; allowed: a number > 0 [m]"));
  EXPECT_THAT(message_of("diameter nan"), HasSubstr("is nan; allowed"));
  EXPECT_THAT(message_of("diameter 1e999"), HasSubstr("too large for a number"));
  EXPECT_THAT(message_of("diameter 1,5"), HasSubstr("which is not a number"));
  EXPECT_THAT(message_of("diameter"), HasSubstr("has no value"));
  EXPECT_THAT(message_of("diameter shoulder 1"), HasSubstr("keyword 'diameter' has no value"));
  EXPECT_THAT(message_of("shoulder 0.1"), HasSubstr("keyword 'diameter' is missing"));
  EXPECT_THAT(message_of("diameter 1 diameter 2"), HasSubstr("given twice"));
  EXPECT_THAT(message_of("diameter 1 segments 9.5"), HasSubstr("an integer in [8, 1000]"));
  EXPECT_THAT(message_of("diameter 1 mode free"), HasSubstr("one of: towed, slip"));
  EXPECT_THAT(message_of("diameter 1 axle 1 2"), HasSubstr("3 numbers"));
  EXPECT_THAT(message_of("diameter 1 table"), HasSubstr("has no value"));
}

TEST(Range, EndsAreOpenOrClosedAndNaNIsNeverInside) {
  EXPECT_FALSE(Range::positive().contains(0.0));
  EXPECT_TRUE(Range::non_negative().contains(0.0));
  EXPECT_FALSE(Range::any().contains(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(Range::any().contains(std::numeric_limits<double>::infinity()));
  EXPECT_EQ((Range{0.0, 0.5, false, true}).text(), "in [0, 0.5)");
}

TEST(Options, ErrorNamesTheLineOfTheFile) {
  const auto message = [](const std::vector<Entry>& entries) {
    return error_of<InputError>([&] { wheel_schema().read(entries); });
  };
  EXPECT_THAT(message({{"diameter", {"-1"}, "wheel.yaml, line 3"}}),
              HasSubstr("wheel.yaml, line 3: fix wheel/rigid, keyword 'diameter' is -1"));
  EXPECT_THAT(message({{"diametre", {"1"}, "wheel.yaml, line 4"}}),
              HasSubstr("wheel.yaml, line 4: fix wheel/rigid has no keyword"));
  EXPECT_THAT(message({{"diameter", {"1"}, "wheel.yaml, line 3"},
                       {"diameter", {"2"}, "wheel.yaml, line 9"}}),
              HasSubstr("wheel.yaml, line 9: fix wheel/rigid, keyword 'diameter' is given twice"));
  const Options options =
      wheel_schema().read(std::vector<Entry>{{"diameter", {"1"}, "wheel.yaml, line 3"}});
  EXPECT_EQ(options.where("diameter"), "wheel.yaml, line 3: fix wheel/rigid, keyword 'diameter'");
  EXPECT_EQ(options.where("shoulder"), "fix wheel/rigid, keyword 'shoulder'");
}

Schema renamed_schema() {
  Schema schema("fix terrain/continuum");
  schema.integer("remap_interval", Range::closed(1, 64), "most steps between two remaps")
      .by_default("16");
  schema.flag("initial_stress", "start with the stress of the own weight").by_default("yes");
  schema.numbers("centre", 2, "m", Range::any(), "x y of the middle").optional();
  schema.alias("cycle", "remap_interval");
  schema.alias("weightless_start", "initial_stress", inverted_flag);
  schema.alias("middle", "centre");
  return schema;
}

TEST(Options, FormerNameWorksWithAWarning) {
  const Options options =
      renamed_schema().read(test::words("cycle 4 middle 1 2 weightless_start yes"));
  EXPECT_EQ(options.integer("remap_interval"), 4);
  EXPECT_EQ(options.numbers("centre"), (std::vector<double>{1, 2}));
  EXPECT_FALSE(options.flag("initial_stress"));
  ASSERT_EQ(options.warnings().size(), 3u);
  EXPECT_EQ(options.warnings()[0],
            "fix terrain/continuum: keyword 'cycle' is now called 'remap_interval'; write "
            "'remap_interval 4'");
  EXPECT_THAT(options.warnings()[1], HasSubstr("write 'centre 1 2'"));
  EXPECT_THAT(options.warnings()[2],
              HasSubstr("'weightless_start' is now called 'initial_stress'; write "
                        "'initial_stress no'"));
  EXPECT_TRUE(renamed_schema().read(test::words("weightless_start no")).flag("initial_stress"));
  // Effective options have the new names.
  EXPECT_EQ(options.effective()[0].key, "remap_interval");
}

TEST(Options, PresentNameGivesNoWarning) {
  EXPECT_TRUE(renamed_schema().read(test::words("remap_interval 4")).warnings().empty());
}

TEST(Options, FormerNameIsCheckedAsThePresentOne) {
  const auto message_of = [](const std::string& line) {
    return error_of<InputError>([&] { renamed_schema().read(test::words(line)); });
  };
  EXPECT_THAT(message_of("cycle 99"),
              HasSubstr("keyword 'cycle' (now 'remap_interval') is 99; allowed: an integer in "
                        "[1, 64]"));
  EXPECT_THAT(message_of("cycle 4 remap_interval 5"),
              HasSubstr("keyword 'remap_interval' is given twice"));
  EXPECT_THAT(message_of("weightless_start maybe"), HasSubstr("allowed: yes or no"));
  EXPECT_THAT(message_of("middle 1 cycle 4"),
              HasSubstr("keyword 'middle' (now 'centre') has 1 value(s)"));
}

TEST(Options, AliasNeedsAnExistingKeyAndAnUnusedName) {
  Schema schema = renamed_schema();
  EXPECT_THROW(schema.alias("old", "no_such_key"), Error);
  EXPECT_THROW(schema.alias("centre", "remap_interval"), Error);
  EXPECT_THROW(schema.alias("cycle", "centre"), Error);
}

}  // namespace
}  // namespace furrow::options_test

// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/results/summary.h"

#include <sstream>

#include <gmock/gmock.h>

namespace furrow::summary_test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

SteadyValue value(const std::string& name, const std::string& unit, double mean, double error,
                  bool steady = true, bool imposed = false) {
  SteadyValue found;
  found.name = name;
  found.unit = unit;
  found.mean = mean;
  found.standard_error = error;
  found.steady = steady;
  found.imposed = imposed;
  return found;
}

/// Summary of a driven wheel at a prescribed slip.
Summary summary() {
  Summary summary;
  summary.info.title = "rigid wheel";
  Resistance& r = summary.resistance;
  r.driven = true;
  r.values = {value("hub_drop", "m", 0.10114, 0.00017),
              value("resistance_coefficient", "", 0.113, 0.014),
              value("net_traction_coefficient", "", -0.113, 0.014, false),
              value("drive_torque", "N m", 12.0, 0.3), value("slip", "", 0.1, 0.0, true, true)};
  r.reasons = {"net traction coefficient: it drifts by 0.08 over the window"};
  return summary;
}

TEST(Summary, VerdictIsOneShortLineBeforeTheValues) {
  EXPECT_EQ(
      verdict_of(summary()),
      "not steady, net traction coefficient -0.113 ± 0.014, hub drop 101.1 ± 0.2 mm; ± over time");
  const std::string text = summary_text(summary());
  EXPECT_THAT(text,
              HasSubstr("\n\nVerdict: not steady, net traction coefficient -0.113 ± 0.014, "));
  EXPECT_LT(text.find("Verdict: "), text.find("Window: "));
  EXPECT_THAT(text, HasSubstr("Not steady\n  net traction coefficient: it drifts by 0.08"));
}

TEST(Summary, NoteOnErrorsListsTheExcludedErrors) {
  const std::string note = error_note("results/a");
  EXPECT_THAT(note, HasSubstr("without cells or grains, ground, packing, material and model"));
  EXPECT_THAT(note, HasSubstr("furrow-post budget results/a\n"));
  const std::string text = summary_text(summary());
  EXPECT_LT(text.find(error_note("<folder of this file>")), text.find("Window: "));
  Summary none;
  none.trouble = "the wheel digs in";
  EXPECT_EQ(summary_text(none).find("over time"), std::string::npos);
}

/// Every line with an error stands below a head, or has a note, with what the error is.
TEST(Summary, EveryTableStatesThatItsErrorsAreOverTime) {
  Summary passes = summary();
  passes.passes = {passes.resistance, passes.resistance};
  std::istringstream text(summary_text(passes));
  std::string line, head;
  int errors = 0;
  while (std::getline(text, line)) {
    if (line.empty() || line.find_first_not_of(' ') == 0) head = line;
    if (line.find("±") == std::string::npos) continue;
    EXPECT_THAT(head, HasSubstr("over time")) << line;
    ++errors;
  }
  EXPECT_GT(errors, 10);
}

TEST(Summary, VerdictNamesValuesOfTheSummary) {
  for (const bool driven : {true, false}) {
    Summary each = summary();
    each.resistance.driven = driven;
    const std::string text = summary_text(each);
    const std::string answer = driven ? "net traction coefficient" : "resistance coefficient";
    EXPECT_THAT(verdict_of(each), HasSubstr(answer));
    EXPECT_THAT(text, HasSubstr("\n  " + answer + " "));
    EXPECT_THAT(text, HasSubstr("\n  hub drop "));
  }
}

TEST(Summary, VerdictHasAtMost91Characters) {
  Summary tiny = summary();
  for (SteadyValue& each : tiny.resistance.values) {
    each.mean *= 1.23456789;
    each.standard_error = 1e-9;
  }
  EXPECT_LE(verdict_of(tiny).size(), 91u + 3u);  // bytes: each ± has two
  EXPECT_THAT(verdict_of(tiny), HasSubstr("net traction coefficient"));
  EXPECT_THAT(verdict_of(tiny), EndsWith("; ± over time"));
  Summary none;
  none.trouble =
      "the wheel digs in: it sinks from 0.1 to 0.3 m over the second half of the cruise; "
      "the axle moves at 0.1 m/s, the rim at 1 m/s";
  EXPECT_EQ(verdict_of(none), "no steady values, the wheel digs in");
}

TEST(Summary, ImposedValuesAreMarkedAndHaveNoError) {
  const std::string text = summary_text(summary());
  EXPECT_THAT(text, HasSubstr("imposed by the scene"));
  Summary free = summary();
  free.resistance.axle_free = true;
  free.resistance.values[2].imposed = true;
  free.resistance.values[4] = value("slip", "", 0.0864, 0.041, false);
  EXPECT_THAT(verdict_of(free),
              StartsWith("not steady, slip 0.09 ± 0.04, hub drop 101.1 ± 0.2 mm"));
}

TEST(Summary, JsonHasSeparateVerdictAndReasons) {
  const std::string json = summary_json(summary());
  EXPECT_THAT(json, HasSubstr(R"("verdict": "not steady, net traction coefficient)"));
  EXPECT_THAT(json, HasSubstr(R"("reasons": [)"));
  EXPECT_THAT(json, HasSubstr(R"("imposed": true)"));
}

}  // namespace
}  // namespace furrow::summary_test

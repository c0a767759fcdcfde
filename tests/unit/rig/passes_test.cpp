// SPDX-License-Identifier: GPL-2.0-or-later
// A wheel that rolls three times over the same floor: the way back is exact, the passes are alike,
// and energy closes over all of them.

#include "furrow/statistics/passes.h"

#include <cmath>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "made_again.h"
#include "tests/support/error_of.h"
#include "wheel_on_floor.h"

namespace furrow::passes_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

constexpr double dt = 1e-4, height = 0.2003;  // [s], [m] of the axle at the start
// settle, accelerate, cruise and back: a period of 1.05 s
const std::string three =
    "load_force 60 speed 1 mode towed damping 600 settle_time 0.3 accelerate_time 0.1 ground_level "
    "0 passes 3 pass_length 0.4 return_time 0.3";

Floor soft_floor() {
  Floor floor;
  floor.creep = 5e-3;
  return floor;
}

History history_of(RigidWheel& wheel, double end) {
  WheelRig rig = rig_of(wheel, three);
  History history(WheelRig::channels());
  const Floor floor = soft_floor();
  run(rig, wheel, end, dt, &floor, [&](const std::vector<double>& row) { history.append(row); });
  return history;
}

TEST(Passes, EveryPassHasTheStartAndLengthOfTheFirst) {
  RigidWheel wheel = make_wheel(height);
  const History history = history_of(wheel, 2.85);
  const std::vector<double> time = history.column("time"), pass = history.column("pass"),
                            stage = history.column("stage"), x = history.column("x"),
                            z = history.column("z"), force = history.column("force_z");
  double highest = 0.0, longest[4] = {};
  for (std::size_t i = 0; i < history.size(); ++i) {
    const double clock = std::fmod(time[i] - 0.5 * dt, 1.05);
    ASSERT_EQ(pass[i], 1.0 + std::floor(time[i] / 1.05 + 1e-9)) << time[i];
    if (stage[i] == 0.0) {
      ASSERT_NEAR(x[i], 0.0, 1e-12) << time[i];
    }
    if (stage[i] == 3.0) {
      highest = std::max(highest, z[i]);
      // lifted: clear of the floor while it goes back
      if (clock > 0.85 && clock < 0.95) {
        ASSERT_EQ(force[i], 0.0) << time[i];
      }
    } else {
      longest[static_cast<int>(pass[i])] = std::max(longest[static_cast<int>(pass[i])], x[i]);
    }
  }
  EXPECT_NEAR(highest, height + 0.04, 1e-9);  // a tenth of the diameter
  for (int n = 1; n <= 3; ++n) EXPECT_NEAR(longest[n], 0.4, 1e-3) << n;
  EXPECT_EQ(stage.back(), 2.0);
  // the audit runs over all of it
  const EnergyBudget budget = wheel.energy_budget();
  EXPECT_NEAR(budget.residual(), 0.0, 1e-10 * std::abs(budget.drive_work));
}

// On a rigid floor every pass has the sinkage and the resistance of the first.
TEST(Passes, PassesOnARigidFloorAreEqual) {
  RigidWheel wheel = make_wheel(height);
  const History history = history_of(wheel, 2.85);
  EXPECT_EQ(count_passes(history), 3);
  const std::vector<Resistance> passes = measure_passes(history, {});
  ASSERT_EQ(passes.size(), 3u);
  for (const Resistance& pass : passes) {
    EXPECT_NEAR(pass.value("hub_drop").mean, passes[0].value("hub_drop").mean, 1e-5);
    EXPECT_NEAR(pass.value("force_z").mean, 60.0, 1.0);
    EXPECT_NEAR(pass.value("resistance_coefficient").mean, 0.0, 0.02);
  }
}

TEST(Passes, RestartOnTheWayBackContinuesBitwise) {
  for (const long from : {8000L, 9000L, 10000L})  // lifted, brought back, lowered
    expect_continues_bitwise(three, soft_floor(), from, from + 3000);
}

TEST(Passes, ContradictingKeywordsAreRefused) {
  const auto refusal_of = [](const std::string& key, const std::string& value) {
    std::vector<std::string> words = test::words(three);
    const auto found = std::find(words.begin(), words.end(), key);
    if (value.empty())
      words.erase(found, found + 2);
    else if (found == words.end())
      words.insert(words.end(), {key, value});
    else
      found[1] = value;
    RigidWheel wheel = make_wheel();
    return error_of<InputError>(
        [&] { WheelRig(WheelRig::schema("fix wheel/rig").read(words), wheel); });
  };
  EXPECT_THAT(refusal_of("passes", "0"), HasSubstr("keyword 'passes' is 0"));
  EXPECT_THAT(refusal_of("passes", "1"), HasSubstr("keyword 'pass_length' is given with passes 1"));
  EXPECT_THAT(refusal_of("pass_length", ""),
              HasSubstr("keyword 'pass_length' is missing with passes 3"));
  EXPECT_THAT(refusal_of("return_time", ""), HasSubstr("keyword 'return_time' is missing"));
  EXPECT_THAT(refusal_of("pass_length", "0.05"),
              HasSubstr("keyword 'pass_length' is 0.05 m; allowed: more than 0.05 m, the travel of "
                        "the acceleration"));
  EXPECT_THAT(refusal_of("speed", "0"), HasSubstr("allowed: a speed > 0"));
}

}  // namespace
}  // namespace furrow::passes_test

// SPDX-License-Identifier: GPL-2.0-or-later
// The time left against simulated histories of cost, whose end is known.

#include "furrow/core/time_left.h"

#include <cmath>
#include <functional>
#include <random>

#include <gmock/gmock.h>

namespace furrow::time_left_test {
namespace {

constexpr int steps = 20000, between_notes = 10;

struct History {
  const char* name;
  std::function<double(double)> cost;  // of a step at this share of the job, in any unit
  double error;                        // allowed, relative, from the first tenth on
};

/// Largest relative error from a tenth to nine tenths; near the end a second more is much.
double largest_error(const History& history, double noise) {
  std::mt19937 random(11);
  std::lognormal_distribution<double> stall(0.0, noise);
  std::vector<double> elapsed = {0.0};
  for (int i = 0; i < steps; ++i)
    elapsed.push_back(elapsed.back() + history.cost(i / double(steps)) * stall(random));
  TimeLeft left;
  double worst = 0.0;
  for (int i = between_notes; i <= 9 * steps / 10; i += between_notes) {
    const double now = elapsed[std::size_t(i)];
    left.note(i / double(steps), now);
    if (i < steps / 10) continue;
    worst = std::max(worst, std::abs(left.estimate() / (elapsed.back() - now) - 1.0));
  }
  return worst;
}

TEST(TimeLeft, EqualStepsGiveAnErrorBelow5Percent) {
  TimeLeft left;
  EXPECT_EQ(left.estimate(), 0.0);
  left.note(0.25, 10.0);
  EXPECT_DOUBLE_EQ(left.estimate(), 30.0);
  left.note(0.5, 20.0);
  EXPECT_DOUBLE_EQ(left.estimate(), 20.0);
  EXPECT_LT(largest_error({"even", [](double) { return 1.0; }, 0.0}, 0.5), 0.05);
}

TEST(TimeLeft, ErrorIsBelow20PercentAfterATenthOfTheRun) {
  const History histories[] = {
      {"free fall until 6 %, then contact that costs twice as much",
       [](double p) { return p < 0.06 ? 1.0 : 2.0; }, 0.20},
      {"a start-up that costs ten times as much, until 2 %",
       [](double p) { return p < 0.02 ? 10.0 : 1.0; }, 0.20},
      {"contacts that grow by 30 % over the run", [](double p) { return 1.0 + 0.3 * p; }, 0.20},
      {"slower and faster by 10 %, five times",
       [](double p) { return 1.0 + 0.1 * std::sin(31.4 * p); }, 0.20},
  };
  for (const History& history : histories)
    EXPECT_LT(largest_error(history, 0.3), history.error) << history.name;
}

TEST(TimeLeft, EstimateFollowsASuddenChangeOfCost) {
  // The mean since the start is wrong by a third at 50 %, and still by a fifth at 75 %.
  TimeLeft left;
  double elapsed = 0.0;
  for (int i = 1; i <= 75; ++i) {
    elapsed += i <= 40 ? 1.0 : 3.0;
    left.note(i / 100.0, elapsed);
  }
  EXPECT_NEAR(left.estimate(), 25 * 3.0, 1e-9);
}

}  // namespace
}  // namespace furrow::time_left_test

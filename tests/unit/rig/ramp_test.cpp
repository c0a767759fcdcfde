// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/rig/ramp.h"

#include <gtest/gtest.h>

namespace furrow::ramp_test {
namespace {

TEST(Ramp, RisesFromZeroToOneWithFlatEnds) {
  const Ramp ramp{2.0, 4.0};
  EXPECT_EQ(ramp.value(1.0), 0.0);
  EXPECT_EQ(ramp.value(2.0), 0.0);
  EXPECT_DOUBLE_EQ(ramp.value(4.0), 0.5);
  EXPECT_EQ(ramp.value(6.0), 1.0);
  EXPECT_EQ(ramp.value(9.0), 1.0);
  EXPECT_EQ(ramp.rate(2.0), 0.0);
  EXPECT_EQ(ramp.rate(6.0), 0.0);
  EXPECT_DOUBLE_EQ(ramp.rate(4.0), 1.875 / 4.0);  // 30/16 over the duration
  EXPECT_DOUBLE_EQ(ramp.end(), 6.0);
}

TEST(Ramp, ValueAndRateAndIntegralAreDerivativesOfEachOther) {
  const Ramp ramp{0.5, 2.0};
  const double h = 1e-5;
  for (double time = 0.3; time < 3.0; time += 0.1) {
    EXPECT_NEAR((ramp.value(time + h) - ramp.value(time - h)) / (2 * h), ramp.rate(time), 1e-8);
    EXPECT_NEAR((ramp.integral(time + h) - ramp.integral(time - h)) / (2 * h), ramp.value(time),
                1e-9);
  }
  // the second derivative vanishes at both ends
  EXPECT_NEAR(ramp.rate(0.5 + h) / h, 0.0, 1e-3);
  EXPECT_NEAR(ramp.rate(2.5 - h) / h, 0.0, 1e-3);
}

TEST(Ramp, IntegralIsHalfTheDurationThenGrowsWithTime) {
  const Ramp ramp{1.0, 3.0};
  EXPECT_DOUBLE_EQ(ramp.integral(4.0), 1.5);
  EXPECT_DOUBLE_EQ(ramp.integral(10.0), 7.5);
  EXPECT_EQ(ramp.integral(0.5), 0.0);
}

TEST(Ramp, MeansAgreeWithTheClosedFormAlsoAcrossTheEnds) {
  const Ramp ramp{1.0, 3.0};
  for (const auto& [from, to] : {std::pair{0.0, 0.5},
                                 {0.0, 2.0},
                                 {1.5, 2.5},
                                 {0.5, 6.0},
                                 {3.5, 5.0},
                                 {5.0, 6.0},
                                 {0.9999, 1.0001}}) {
    EXPECT_NEAR(ramp.mean(from, to), (ramp.integral(to) - ramp.integral(from)) / (to - from),
                1e-12);
    EXPECT_NEAR(ramp.mean_rate(from, to), (ramp.value(to) - ramp.value(from)) / (to - from), 1e-12);
  }
  EXPECT_EQ(ramp.mean(7.0, 7.1), 1.0);
  EXPECT_NEAR(ramp.mean(2.5, 2.5 + 1e-9), 0.5, 1e-9);
}

TEST(Ramp, ZeroDurationIsAStep) {
  const Ramp step{1.0, 0.0};
  EXPECT_EQ(step.value(0.999), 0.0);
  EXPECT_EQ(step.value(1.0), 1.0);
  EXPECT_DOUBLE_EQ(step.integral(3.0), 2.0);
  EXPECT_DOUBLE_EQ(step.mean(0.5, 1.5), 0.5);
  EXPECT_EQ(step.rate(1.0), 0.0);
}

}  // namespace
}  // namespace furrow::ramp_test

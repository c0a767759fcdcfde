// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/statistics/steady_state.h"

#include <cmath>
#include <random>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "furrow/core/types.h"
#include "furrow/statistics/rig_stage.h"
#include "tests/support/error_of.h"

namespace furrow::steady_state_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

/// x_i = phi x_{i-1} + sqrt(1 - phi^2) noise: unit variance, integrated autocorrelation time (1 +
/// phi)/(1 - phi)/2 rows.
std::vector<double> autoregressive(double phi, std::size_t rows, unsigned seed, double mean = 0.0) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> values(rows);
  double value = normal(random);
  for (double& each : values) {
    each = mean + value;
    value = phi * value + std::sqrt(1.0 - phi * phi) * normal(random);
  }
  return values;
}

// The mean of n correlated values has the variance 2 tau/n: bars of two errors hold it in 95 % of
// the runs, but for the scatter of the error itself. Over 1000 seeds the share has a standard error
// of 0.7 %.
TEST(SteadyState, ErrorBarsOfCorrelatedSignalsCoverTheTruth) {
  for (const double phi : {0.0, 0.5, 0.9, 0.97}) {
    const int seeds = 1000;
    const std::size_t rows = 5000;
    const double tau = 0.5 * (1.0 + phi) / (1.0 - phi),
                 truth = std::sqrt(2.0 * tau / static_cast<double>(rows));
    int covered = 0;
    double error = 0.0, time = 0.0, samples = 0.0;
    for (int seed = 0; seed < seeds; ++seed) {
      const SteadyValue value =
          analyse_steady("x", "", autoregressive(phi, rows, static_cast<unsigned>(seed)), 0.1, 1.0);
      covered += std::abs(value.mean) < 2.0 * value.standard_error;
      error += value.standard_error / seeds;
      time += value.correlation_time / seeds;
      samples += value.independent_samples / seeds;
    }
    EXPECT_GE(covered, 0.90 * seeds) << "phi " << phi;
    EXPECT_LE(covered, 0.98 * seeds) << "phi " << phi;
    EXPECT_NEAR(error / truth, 1.0, 0.1) << "phi " << phi;
    EXPECT_NEAR(time / (tau * 0.1), 1.0, 0.2) << "phi " << phi;
    EXPECT_NEAR(samples / (static_cast<double>(rows) / (2.0 * tau)), 1.0, 0.3) << "phi " << phi;
  }
}

TEST(SteadyState, SteadySignalsAreReportedSteady) {
  int steady = 0;
  const int seeds = 500;
  for (int seed = 0; seed < seeds; ++seed)
    steady +=
        analyse_steady("x", "", autoregressive(0.9, 4000, static_cast<unsigned>(seed), 5.0), 0.1)
            .steady;
  EXPECT_GE(steady, 0.97 * seeds);  // two tests at 99 %
}

TEST(SteadyState, DriftsAreDetectedAndReported) {
  int found = 0;
  const int seeds = 200;
  for (int seed = 0; seed < seeds; ++seed) {
    std::vector<double> values = autoregressive(0.9, 4000, static_cast<unsigned>(seed), 10.0);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] += 2.0 * static_cast<double>(i) / 4000.0;
    const SteadyValue value = analyse_steady("x", "N", values, 0.1);
    found += !value.steady;
    if (seed == 0) {
      EXPECT_THAT(value.verdict, HasSubstr("not steady: it drifts by"));
      EXPECT_THAT(value.verdict, HasSubstr("N over the window; its halves differ by"));
      EXPECT_NEAR(value.drift, 2.0, 4.0 * value.drift_error);
      EXPECT_NEAR(value.halves_difference, 1.0, 4.0 * value.halves_error);
    }
  }
  EXPECT_GE(found, 0.98 * seeds);
}

// The slope of a line has the error sqrt(12) of the mean's, the difference of the halves twice of
// it: checked by its scatter.
TEST(SteadyState, ErrorsOfDriftAndHalvesAreTheirScatter) {
  const int seeds = 1000;
  double drift = 0.0, drift_error = 0.0, halves = 0.0, halves_error = 0.0;
  for (int seed = 0; seed < seeds; ++seed) {
    const SteadyValue value =
        analyse_steady("x", "", autoregressive(0.8, 4000, static_cast<unsigned>(seed)), 1.0, 1.0);
    drift += value.drift * value.drift;
    drift_error += value.drift_error * value.drift_error;
    halves += value.halves_difference * value.halves_difference;
    halves_error += value.halves_error * value.halves_error;
  }
  EXPECT_NEAR(std::sqrt(drift_error / drift), 1.0, 0.1);
  EXPECT_NEAR(std::sqrt(halves_error / halves), 1.0, 0.1);
}

// A towed wheel's slip: swings on top of slow wandering. At a block length of one swing the block
// means hardly scatter; that dip is no certainty about the slow part. The share of means within two
// errors of the truth, zero (two thirds if the dip counted).
TEST(SteadyState, ErrorBarsCoverASlowDriftUnderOscillations) {
  const int seeds = 500;
  int covered = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    std::vector<double> values = autoregressive(0.97, 1200, static_cast<unsigned>(seed));
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] += 5.0 * std::sin(2.0 * pi * (static_cast<double>(i) / 20.0 + 0.618 * seed));
    const SteadyValue value = analyse_steady("x", "", values, 0.1, 1.0);
    covered += std::abs(value.mean) < 2.0 * value.standard_error;
  }
  EXPECT_GE(covered, 0.90 * seeds);
}

// The ripple of grousers: its incomplete period is an error of the mean that the bars must hold, in
// any phase.
TEST(SteadyState, PeriodicRipplesAreSteadyWithACoveringError) {
  int covered = 0, steady = 0;
  const int phases = 100;
  for (int phase = 0; phase < phases; ++phase) {
    std::vector<double> values = autoregressive(0.5, 5000, static_cast<unsigned>(phase), 10.0);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] += 3.0 * std::sin(2.0 * pi * (static_cast<double>(i) / 230.0 + 0.01 * phase));
    const SteadyValue value = analyse_steady("x", "", values, 0.1);
    covered += std::abs(value.mean - 10.0) < 2.0 * value.standard_error;
    steady += value.steady;
  }
  EXPECT_GE(covered, 0.95 * phases);
  EXPECT_GE(steady, 0.95 * phases);
}

TEST(SteadyState, SignificantButNegligibleDriftIsSteady) {
  std::vector<double> values = autoregressive(0.0, 4000, 3);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = 100.0 + 0.01 * values[i] + 0.5 * static_cast<double>(i) / 4000.0;
  const SteadyValue value = analyse_steady("x", "", values, 1.0);
  EXPECT_GT(value.drift, 100.0 * value.drift_error);
  EXPECT_TRUE(value.steady) << value.verdict;
  SteadyCriteria strict;
  strict.negligible_drift = 1e-3;
  EXPECT_FALSE(analyse_steady("x", "", values, 1.0, 0.0, strict).steady);
}

TEST(SteadyState, ConstantIsSteadyWithZeroError) {
  const SteadyValue value = analyse_steady("slip", "", std::vector<double>(1000, 0.2), 0.01);
  EXPECT_NEAR(value.mean, 0.2, 1e-13);
  EXPECT_NEAR(value.standard_error, 0.0, 1e-13);
  EXPECT_TRUE(value.steady);
  EXPECT_EQ(value.verdict, "steady");
  std::vector<double> rounded(1000, 0.2);
  for (std::size_t i = 0; i < rounded.size(); ++i) rounded[i] += 1e-16 * static_cast<double>(i);
  EXPECT_TRUE(analyse_steady("slip", "", rounded, 0.01).steady);
  EXPECT_TRUE(analyse_steady("torque", "N m", std::vector<double>(1000, 0.0), 0.01).steady);
}

TEST(SteadyState, WindowOfAFewCorrelationTimesIsTooShort) {
  int refused = 0;
  const int seeds = 100;
  for (int seed = 0; seed < seeds; ++seed)
    refused +=
        !analyse_steady("x", "", autoregressive(0.999, 2000, static_cast<unsigned>(seed), 1.0), 0.1)
             .steady;
  EXPECT_GE(refused, 0.9 * seeds);  // two correlation times
  const SteadyValue few = analyse_steady("x", "", {1.0, 2.0, 1.5, 1.2}, 0.1);
  EXPECT_FALSE(few.steady);
  EXPECT_THAT(few.verdict,
              HasSubstr("the window is too short: its fluctuations last so long that it has only 2 "
                        "independent stretches, 6 are needed"));
}

TEST(SteadyState, FewBlocksSufficeWhenTheyHardlyDiffer) {
  // one and a half slow swings about 1, which hold fewer than six stretches
  const auto swings = [](double amplitude) {
    std::vector<double> values(1000);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = 1.0 + amplitude * std::cos(0.003 * M_PI * static_cast<double>(i));
    return analyse_steady("x", "m", values, 0.01);
  };
  EXPECT_TRUE(swings(0.001).steady) << swings(0.001).verdict;
  EXPECT_LT(swings(0.001).blocks, 6u);
  EXPECT_TRUE(swings(0.009).steady);  // no value departs from the mean by 1 %
  EXPECT_FALSE(swings(0.02).steady);
  // a trend that is certain is one, however small the range
  std::vector<double> line(1000);
  for (std::size_t i = 0; i < line.size(); ++i) line[i] = 1.0 + 4e-5 * static_cast<double>(i);
  EXPECT_THAT(analyse_steady("x", "m", line, 0.01).verdict, HasSubstr("it drifts by 0.04"));
}

TEST(SteadyState, ReportsSpreadAndExtremes) {
  const SteadyValue value = analyse_steady("x", "m", {1.0, 3.0, 1.0, 3.0, 1.0, 3.0, 1.0, 3.0}, 0.5);
  EXPECT_DOUBLE_EQ(value.mean, 2.0);
  EXPECT_DOUBLE_EQ(value.deviation, std::sqrt(8.0 / 7.0));
  EXPECT_EQ(value.minimum, 1.0);
  EXPECT_EQ(value.maximum, 3.0);
  EXPECT_EQ(value.name, "x");
  EXPECT_EQ(value.unit, "m");
}

TEST(SteadyState, ShortOrNonFiniteSeriesAreRefused) {
  EXPECT_THAT(error_of([] { analyse_steady("sinkage", "m", {1.0}, 1.0); }),
              HasSubstr("sinkage: 1 value(s) have no standard error"));
  EXPECT_THAT(error_of([] {
                analyse_steady("sinkage", "m", {1.0, std::nan("")}, 1.0);
              }),
              HasSubstr("sinkage: a value of the window is not finite"));
}

TEST(SteadyState, MserTruncatesADecayingTransientAlone) {
  double truncation = 0.0, without = 0.0;
  const int seeds = 200;
  for (int seed = 0; seed < seeds; ++seed) {
    std::vector<double> values = autoregressive(0.5, 2000, static_cast<unsigned>(seed));
    without += static_cast<double>(mser_truncation(values)) / seeds;
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] += 20.0 * std::exp(-static_cast<double>(i) / 50.0);
    const std::size_t left_out = mser_truncation(values);
    truncation += static_cast<double>(left_out) / seeds;
    EXPECT_GE(left_out, 100u);  // there the transient is still 2.7 deviations
    EXPECT_EQ(left_out % 5, 0u);
  }
  EXPECT_LE(truncation, 400.0);
  EXPECT_LE(without, 200.0);
  EXPECT_EQ(mser_truncation(std::vector<double>(500, 3.0)), 0u);
  EXPECT_EQ(mser_truncation({1.0, 2.0, 3.0}), 0u);
}

// A signal without a transient that is correlated over a twentieth of it loses more than a fifth in
// 0.8 % of the runs; by the least of the statistic alone, in 6 %.
TEST(SteadyState, MserIgnoresACalmEnd) {
  int much = 0;
  const int seeds = 500;
  for (int seed = 0; seed < seeds; ++seed)
    much += mser_truncation(autoregressive(0.98, 2000, static_cast<unsigned>(seed))) > 400;
  EXPECT_LE(much, seeds / 50);
}

TEST(SteadyState, MserTruncatesAtMostHalf) {
  std::vector<double> values(1000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i);
  EXPECT_EQ(mser_truncation(values), 500u);
}

/// It settles and accelerates for 1 s each, then cruises. The force decays into noise.
History rolling(double transient_time, double end = 10.0) {
  History history({{"time", "s", ""}, {"stage", "", ""}, {"x", "m", ""}, {"force", "N", ""}});
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i <= std::lround(end / 0.01); ++i) {
    const double time = 0.01 * i, stage = time < 1.0 - 1e-9 ? 0 : time < 2.0 - 1e-9 ? 1 : 2;
    history.append({time, stage, 2.0 * std::max(0.0, time - 1.0),
                    7.0 + normal(random) + 50.0 * std::exp(-(time - 2.0) / transient_time)});
  }
  return history;
}

TEST(Window, WindowBeginsAfterTheTransientOfTheCruise) {
  const Window window = select_window(rolling(0.2), {}, {"force"});
  EXPECT_TRUE(window.automatic);
  EXPECT_GT(window.begin, 2.4);
  EXPECT_LT(window.begin, 4.0);
  EXPECT_DOUBLE_EQ(window.end, 10.0);
  EXPECT_EQ(window.last, 1001u);
  EXPECT_NEAR(window.distance, 2.0 * (10.0 - window.begin), 1e-12);
  EXPECT_THAT(window.how, HasSubstr("cruise from 2 s, transient of"));
  EXPECT_THAT(window.how, HasSubstr("left out (MSER-5 on force)"));
  EXPECT_EQ(window.warning, "");
}

TEST(Window, RoundingErrorsAreNoTransient) {
  History history({{"time", "s", ""}, {"x", "m", ""}, {"slip", "", ""}});
  // a slip of 0, rounded
  for (int i = 0; i < 1000; ++i) history.append({0.01 * i, 0.02 * i, 1e-16 * i});
  const Window window = select_window(history, {}, {"slip"});
  EXPECT_EQ(window.first, 0u);
  EXPECT_EQ(window.warning, "");
}

TEST(Window, GivenWindowBeforeTheCruiseIsWarnedOf) {
  WindowRequest request;
  request.to_time = 9.0;
  request.from_time = 0.5;
  EXPECT_THAT(select_window(rolling(0.2), request, {"force"}).warning,
              HasSubstr("the window begins before the cruise"));
  request.from_time = 2.0;
  EXPECT_EQ(select_window(rolling(0.2), request, {"force"}).warning, "");
}

TEST(Window, TransientOfHalfTheCruiseIsWarnedOf) {
  EXPECT_THAT(select_window(rolling(20.0), {}, {"force"}).warning,
              HasSubstr("the transient of force fills nearly half of the cruise: run longer"));
}

TEST(Window, NegligibleCreepIsNoTransient) {
  History history({{"time", "s", ""}, {"x", "m", ""}, {"sinkage", "m", ""}});
  // creeps on for ever, by a hundredth in the second half
  for (int i = 0; i < 1000; ++i)
    history.append({0.01 * i, 0.02 * i, 0.1 + 0.004 * std::exp(-0.0028 * i)});
  const Window window = select_window(history, {}, {"sinkage"});
  EXPECT_GE(window.first, 450u);
  EXPECT_EQ(window.warning, "");
}

// A ripple of the grousers about a mean of 1 at 0.37 pitches per second over 10.3 s of cruise. The
// mean over whole pitches is exact, that over all rows is not.
TEST(Window, WindowCoversWholePitchesOfGrousers) {
  History history(
      {{"time", "s", ""}, {"x", "m", ""}, {grouser_channel, "", ""}, {"depth", "m", ""}});
  double all = 0.0;
  constexpr int rows = 1030;
  for (int i = 0; i < rows; ++i) {
    const double time = 0.01 * i, pitches = 0.37 * time,
                 depth = 1.0 + 0.3 * std::sin(2.0 * pi * pitches);
    history.append({time, 0.5 * time, pitches, depth});
    all += depth / rows;
  }
  const Window window = select_window(history, {}, {});
  EXPECT_NEAR(window.end - window.begin + 0.01, 3.0 / 0.37, 0.006);
  EXPECT_EQ(window.last, history.size());
  EXPECT_THAT(window.how, HasSubstr("trimmed to 3 whole pitches of grousers"));
  double mean = 0.0;
  for (std::size_t i = window.first; i < window.last; ++i)
    mean += history.at(i, 3) / static_cast<double>(window.rows());
  EXPECT_NEAR(mean, 1.0, 2e-4);
  EXPECT_GT(std::abs(all - 1.0), 5e-3);
  WindowRequest given;
  given.from_time = 1.0;
  EXPECT_NEAR(select_window(history, given, {}).begin, 1.0, 1e-12);
}

TEST(Window, WindowShorterThanAPitchOfGrousersIsWarnedOf) {
  History history({{"time", "s", ""}, {"x", "m", ""}, {grouser_channel, "", ""}});
  for (int i = 0; i < 100; ++i) history.append({0.01 * i, 0.01 * i, 0.005 * i});
  const Window window = select_window(history, {}, {});
  EXPECT_THAT(window.warning, HasSubstr("shorter than the pitch of the grousers"));
  EXPECT_EQ(window.rows(), 100u);
}

TEST(Window, UserSetsTheWindowByTimeOrDistance) {
  WindowRequest by_time;
  by_time.from_time = 4.0;
  by_time.to_time = 6.0;
  const Window timed = select_window(rolling(0.2), by_time, {"force"});
  EXPECT_NEAR(timed.begin, 4.0, 1e-12);
  EXPECT_NEAR(timed.end, 6.0, 1e-12);
  EXPECT_EQ(timed.rows(), 201u);
  EXPECT_FALSE(timed.automatic);
  EXPECT_THAT(timed.how, HasSubstr("given by time: 4 to 6 s"));

  WindowRequest by_distance;
  by_distance.from_distance = 6.0;
  const Window travelled = select_window(rolling(0.2), by_distance, {"force"});
  EXPECT_NEAR(travelled.begin, 4.0, 1e-12);
  EXPECT_NEAR(travelled.end, 10.0, 1e-12);
  EXPECT_NEAR(travelled.distance, 12.0, 1e-12);
}

TEST(Window, WindowBeyondTheHistoryIsRefused) {
  WindowRequest request;
  request.from_time = 11.0;
  EXPECT_THAT(error_of([&] { select_window(rolling(0.2), request, {}); }),
              HasSubstr("the window by time is 11 to 10 s; allowed: a part of 0 to 10 s"));
  request.from_time = 5.0;
  request.to_time = 4.0;
  EXPECT_THAT(error_of([&] { select_window(rolling(0.2), request, {}); }),
              HasSubstr("the begin before the end"));
  request.to_time.reset();
  request.from_distance = 1.0;
  EXPECT_THAT(error_of([&] { select_window(rolling(0.2), request, {}); }),
              HasSubstr("is given by time and by distance; allowed: one of them"));
  WindowRequest narrow;
  narrow.from_time = 4.001;
  narrow.to_time = 4.002;
  EXPECT_THAT(error_of([&] { select_window(rolling(0.2), narrow, {}); }),
              HasSubstr("has 0 row(s): widen it"));
  EXPECT_THAT(error_of([&] { select_window(rolling(0.2, 1.5), {}, {"force"}); }),
              HasSubstr("the history ends before the cruise begins"));
  EXPECT_THAT(error_of([&] {
                select_window(History({{"time", "s", ""}, {"x", "m", ""}}), {}, {});
              }),
              HasSubstr("the history has 0 rows"));
}

}  // namespace
}  // namespace furrow::steady_state_test

// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/statistics/resistance.h"

#include <cmath>
#include <map>
#include <random>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "furrow/rig/wheel_rig.h"
#include "tests/unit/rig/wheel_on_floor.h"
#include "tests/support/error_of.h"

namespace furrow::resistance_test {
namespace {

using test::error_of;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A synthetic run: force_z = 100 (1 + noise), force_x = -0.2 force_z + own noise, both AR(1); 10 s
/// of cruise at 1 m/s.
struct SyntheticRun {
  unsigned seed = 1;
  double hub_drop_drift = 0.0;  // [m] over the cruise
  double end = 12.0;            // [s]
  double skipped_from = 100.0, skipped_to = 100.0;
  double load = 100.0;  // [N]
  /// About their means, -0.05 and -0.2 load: one slow AR(1) signal of this deviation and
  /// correlation time [s], and a drift over the cruise
  double slow_deviation = 0.0, correlation_time = 1.0, slow_drift = 0.0;
  double torque = 0.0;  // [N m]

  History history() const {
    History result({{"time", "s", ""},
                    {"stage", "", ""},
                    {"x", "m", ""},
                    {"hub_drop", "m", ""},
                    {"force_x", "N", ""},
                    {"force_z", "N", ""},
                    {"drawbar_pull", "N", ""},
                    {"drive_torque", "N m", ""},
                    {"slip", "", ""}});
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    double vertical = 0.0, own = 0.0, wave = normal(random);
    const double memory = std::exp(-0.002 / correlation_time);
    for (int i = 0; i <= std::lround(end / 0.002); ++i) {
      const double time = 0.002 * i;
      vertical = 0.9 * vertical + 0.02 * normal(random);
      own = 0.9 * own + 0.3 * normal(random);
      if (slow_deviation > 0.0)
        wave = memory * wave + std::sqrt(1.0 - memory * memory) * normal(random);
      if (time > skipped_from && time < skipped_to) continue;
      const double force_z = load * (1.0 + vertical), force_x = -0.2 * force_z + own;
      const double stage = time < 1.0 ? 0.0 : time < 2.0 ? 1.0 : 2.0;
      const double sinkage =
          0.03 + 1e-4 * normal(random) + hub_drop_drift * std::max(0.0, time - 2.0) / 10.0;
      const double slow = slow_deviation * wave + slow_drift * std::max(0.0, time - 2.0) / 10.0;
      result.append({time, stage, std::max(0.0, time - 1.5), sinkage, force_x, force_z,
                     slow_deviation > 0.0 ? load * (slow - 0.2) : force_x, torque, -0.05 + slow});
    }
    return result;
  }
};

TEST(Resistance, ChannelsOfTheRigAreFound) {
  const History record(WheelRig::channels()), synthetic = SyntheticRun().history();
  for (const Channel& channel : synthetic.channels()) {
    // throws for a name that the rig does not know
    const std::size_t index = record.index(channel.name);
    EXPECT_EQ(record.channels()[index].unit, channel.unit);
  }
}

TEST(Resistance, CoefficientIsTheRatioOfMeansWithItsError) {
  const Resistance result = measure_resistance(SyntheticRun().history());
  EXPECT_TRUE(result.steady);
  EXPECT_THAT(result.reasons, IsEmpty());
  const SteadyValue& c = result.value("resistance_coefficient");
  EXPECT_NEAR(c.mean, 0.2, 4.0 * c.standard_error);
  EXPECT_NEAR(result.value("hub_drop").mean, 0.03, 4.0 * result.value("hub_drop").standard_error);
  EXPECT_NEAR(result.value("force_z").mean, 100.0, 4.0 * result.value("force_z").standard_error);
  EXPECT_NEAR(result.value("slip").mean, -0.05, 1e-13);
  EXPECT_EQ(result.value("drive_torque").mean, 0.0);
  EXPECT_DOUBLE_EQ(result.value("net_traction_coefficient").mean, -c.mean);
  EXPECT_DOUBLE_EQ(result.value("net_traction_coefficient").standard_error, c.standard_error);
  EXPECT_EQ(result.value("drawbar_pull").unit, "N");
}

// From the rig to the figure: a locked wheel dragged over a floor of friction mu has the resistance
// coefficient mu.
TEST(Resistance, CoefficientOfALockedWheelIsTheFriction) {
  RigidWheel wheel = make_wheel(0.2003);
  const Floor floor;
  WheelRig rig(WheelRig::schema().read(std::vector<std::string>{
                   "load_force", "60", "speed", "1", "mode", "slip", "slip", "-1", "settle_time",
                   "0.1", "accelerate_time", "0.1", "ground_level", "0", "damping", "600"}),
               wheel);
  History history(WheelRig::channels());
  run(rig, wheel, 0.8, 4e-5, &floor, [&](const std::vector<double>& row) { history.append(row); });
  const Resistance result = measure_resistance(history);
  EXPECT_THAT(result.reasons, IsEmpty());
  EXPECT_GE(result.window.begin, 0.2 - 1e-9);
  EXPECT_NEAR(result.value("resistance_coefficient").mean, floor.friction, 1e-6);
  EXPECT_NEAR(result.value("net_traction_coefficient").mean, -floor.friction, 1e-3);
  EXPECT_NEAR(result.value("force_z").mean, 60.0, 0.1);
  EXPECT_NEAR(result.value("slip").mean, -1.0, 1e-12);
  EXPECT_NEAR(result.value("drive_torque").mean, -floor.friction * 60.0 * 0.2, 0.05);
}

// The noise that both forces share does not enter their ratio: its error is that of the own noise
// alone, over the mean load. own: deviation 0.3/sqrt(1 - 0.81), inefficiency (1 + 0.9)/(1 - 0.9)
// = 19.
TEST(Resistance, ErrorOfTheRatioIsItsScatterOverManyRuns) {
  double squares = 0.0, errors = 0.0, expected = 0.0;
  const int runs = 200;
  for (int run = 0; run < runs; ++run) {
    SyntheticRun synthetic;
    synthetic.seed = static_cast<unsigned>(run);
    const Resistance result = measure_resistance(synthetic.history());
    const SteadyValue& c = result.value("resistance_coefficient");
    squares += (c.mean - 0.2) * (c.mean - 0.2) / runs;
    errors += c.standard_error * c.standard_error / runs;
    expected += 0.09 / 0.19 * 19.0 / static_cast<double>(result.window.rows()) / 1e4 / runs;
  }
  EXPECT_NEAR(std::sqrt(errors / expected), 1.0, 0.1);
  // a deviation from 200 runs is known within 5 %
  EXPECT_NEAR(std::sqrt(squares / expected), 1.0, 0.15);
}

// A tyre has three depths, a rigid wheel one; a wheel with an axle torque is driven.
TEST(Resistance, DepthsOfATyreAndTheDriveAreReported) {
  const History rigid = SyntheticRun().history();
  std::vector<Channel> channels = rigid.channels();
  channels.push_back({"tyre_deflection", "m", ""});
  channels.push_back({"rut_depth", "m", ""});
  History tyre(channels);
  for (std::size_t i = 0; i < rigid.size(); ++i) {
    std::vector<double> row;
    for (std::size_t k = 0; k < rigid.channels().size(); ++k) row.push_back(rigid.at(i, k));
    row[7] = 12.0;  // drive_torque
    row.push_back(0.012);
    row.push_back(row[3] - 0.012);
    tyre.append(row);
  }
  const Resistance of_rigid = measure_resistance(rigid), of_tyre = measure_resistance(tyre);
  EXPECT_FALSE(of_rigid.has("rut_depth"));
  EXPECT_FALSE(of_rigid.driven);
  EXPECT_TRUE(of_tyre.driven);
  EXPECT_NEAR(of_tyre.value("tyre_deflection").mean, 0.012, 1e-12);
  EXPECT_NEAR(of_tyre.value("rut_depth").mean, of_tyre.value("hub_drop").mean - 0.012, 1e-12);
}

TEST(Resistance, DriftingHubDropMakesTheRunUnsteady) {
  SyntheticRun run;
  run.hub_drop_drift = 0.01;
  const Resistance result = measure_resistance(run.history());
  EXPECT_FALSE(result.steady);
  EXPECT_THAT(result.reasons, Contains(HasSubstr("hub drop: it drifts by")));
  EXPECT_FALSE(result.value("hub_drop").steady);
  EXPECT_TRUE(result.value("resistance_coefficient").steady);
}

// Ten seconds hold five independent values of a signal that is correlated over one: too few
// stretches for a verdict, unless the mean is known to 0.02 in slip and 0.5 % of the load in a
// pull, or a drift over the cruise is larger.
TEST(Resistance, SlipIsScaledBySpeedAndPullByLoad) {
  struct Case {
    double deviation, drift;
    bool slip, pull;  // steady in most runs
  };
  ResistanceOptions cruise;
  cruise.window.from_time = 2.0;
  for (const Case& expected :
       {Case{0.001, 0.0, true, true}, Case{0.004, 0.0, true, false}, Case{0.1, 0.0, false, false},
        Case{0.0001, 0.004, true, true}, Case{0.0001, 0.05, false, false}}) {
    int slip = 0, pull = 0;
    const int runs = 40;
    for (int run = 0; run < runs; ++run) {
      SyntheticRun synthetic;
      synthetic.seed = static_cast<unsigned>(run);
      synthetic.slow_deviation = expected.deviation;
      synthetic.slow_drift = expected.drift;
      const Resistance result = measure_resistance(synthetic.history(), cruise);
      slip += result.value("slip").steady;
      pull += result.value("drawbar_pull").steady;
    }
    const int most = 3 * runs / 5;
    EXPECT_TRUE(expected.slip ? slip > most : slip < runs - most)
        << expected.deviation << " " << expected.drift << ": " << slip << " of " << runs;
    EXPECT_TRUE(expected.pull ? pull > most : pull < runs - most)
        << expected.deviation << " " << expected.drift << ": " << pull << " of " << runs;
  }
}

// A nearly free axle and a wheel that runs straight: means of torque and lateral force are zero
TEST(Resistance, TorqueNearZeroIsScaledByLoadTimesRadius) {
  for (const double amplitude : {0.01, 5.0}) {  // [N m], of 100 N at 0.2 m
    History history(WheelRig::channels());
    for (int i = 0; i <= 1000; ++i) {
      const double x = 0.01 * i;
      std::vector<double> row(history.channels().size(), 0.0);
      for (const auto& [name, value] :
           std::map<std::string, double>{{"time", x},
                                         {"stage", 2.0},
                                         {"x", x},
                                         {"force_z", 100.0},
                                         {"rim_speed", 1.0},
                                         {"spin_rate", 5.0},
                                         {"hub_drop", 0.01 + 1e-6 * std::sin(40.0 * x)},
                                         {"drive_torque", amplitude * std::sin(x)}})
        row[history.index(name)] = value;
      history.append(row);
    }
    const SteadyValue torque = measure_resistance(history).value("drive_torque");
    EXPECT_EQ(torque.steady, amplitude < 1.0) << torque.verdict;
  }
}

TEST(Resistance, UnsteadyValuesWithOneReasonAreListedTogether) {
  ResistanceOptions options;
  options.criteria.min_blocks = 1000;
  options.criteria.known_mean = 0.0;
  const Resistance result = measure_resistance(SyntheticRun().history(), options);
  EXPECT_FALSE(result.steady);
  std::size_t unsteady = 0;
  for (const SteadyValue& value : result.values) {
    if (value.steady || value.name == "net_traction_coefficient") continue;
    ++unsteady;
    EXPECT_THAT(result.reasons, Contains(HasSubstr(plain_name(value.name))));
  }
  EXPECT_GE(unsteady, 2u);
  EXPECT_LT(result.reasons.size(), unsteady);
}

// The summary of a towed wheel does not list its net traction.
TEST(Resistance, ReasonsListOnlyValuesOfTheSummary) {
  ResistanceOptions options;
  options.criteria.min_blocks = 1000;
  options.criteria.known_mean = 0.0;
  const Resistance result = measure_resistance(SyntheticRun().history(), options);
  EXPECT_FALSE(result.value("net_traction_coefficient").steady);
  EXPECT_THAT(result.reasons, Not(Contains(HasSubstr("net traction"))));
}

TEST(Resistance, PrescribedSlipIsImposedAndHasNoError) {
  SyntheticRun run;
  run.torque = 12.0;
  const Resistance driven = measure_resistance(run.history());
  EXPECT_TRUE(driven.value("slip").imposed);
  EXPECT_EQ(driven.value("slip").standard_error, 0.0);
  EXPECT_EQ(driven.answer().name, "net_traction_coefficient");
  EXPECT_FALSE(driven.answer().imposed);
}

// Slope and drawbar load set the pull of a wheel that is free along x: it answers with its slip.
// Wheels of one vehicle share the pull.
TEST(Resistance, PullOfAFreeAxleIsImposedUnlessOthersShareIt) {
  SyntheticRun run;
  run.torque = 12.0;
  run.slow_deviation = 1e-4;  // of the slip
  const History prescribed = run.history();
  std::vector<Channel> channels = prescribed.channels();
  channels.push_back({"axle_free", "", ""});
  channels.push_back({"velocity_x", "m/s", ""});
  channels.push_back({"rim_speed", "m/s", ""});
  for (const double axle_free : {1.0, 2.0}) {
    History free(channels);
    for (std::size_t i = 0; i < prescribed.size(); ++i) {
      std::vector<double> row;
      for (std::size_t k = 0; k < prescribed.channels().size(); ++k)
        row.push_back(prescribed.at(i, k));
      if (axle_free == 1.0) row[6] = 21.0;  // drawbar_pull
      row.insert(row.end(), {axle_free, 1.0, 1.0});
      free.append(row);
    }
    const Resistance result = measure_resistance(free);
    for (const char* name :
         {"drawbar_pull", "net_traction_coefficient", "resistance_coefficient"}) {
      EXPECT_EQ(result.value(name).imposed, axle_free == 1.0) << name;
      EXPECT_EQ(result.value(name).standard_error == 0.0, axle_free == 1.0) << name;
    }
    EXPECT_FALSE(result.value("slip").imposed);
    EXPECT_EQ(result.answer().name, "slip");
  }
  EXPECT_FALSE(measure_resistance(prescribed).value("drawbar_pull").imposed);
}

// Noise of the axle force that the ground does not have: both coefficients carry the larger error.
TEST(Resistance, QuantityAndItsNegativeShareOneError) {
  SyntheticRun run;
  run.slow_deviation = 0.01;
  run.correlation_time = 0.05;
  const Resistance result = measure_resistance(run.history());
  const SteadyValue &c = result.value("resistance_coefficient"),
                    &n = result.value("net_traction_coefficient");
  EXPECT_NE(c.mean, -n.mean);
  EXPECT_EQ(c.standard_error, n.standard_error);
  EXPECT_GT(c.standard_error, 1e-4);
}

using Rates = std::map<std::string, double>;  // channel -> [J/m]

/// Rates of all parts in wheel, snow and grains, 0.5 J/m less than axle and load put in.
Rates rates_of_all_parts() {
  return {{"compaction_work", 50.0}, {"bulldozing_work", 20.0},    {"grid_loss", 4.0},
          {"continuum_work", 74.0},  {"friction_loss", 8.0},       {"contact_damping_loss", 1.0},
          {"wheel_loss", 3.0},       {"contact_spring_loss", 2.0}, {"stored_energy", 1.0},
          {"damping_loss", 0.5},     {"kinetic_energy", 2.0},      {"drive_work", 94.0},
          {"load_work", 5.0},        {"grain_press_work", 9.0},    {"grain_push_work", -2.0}};
}

/// Parts of a run of 10 m in which every energy grows at a constant rate, with the rig's channels.
ResistanceParts parts_of(const Rates& rates) {
  History history(WheelRig::channels());
  for (int i = 0; i <= 500; ++i) {
    const double x = 0.02 * i;
    std::vector<double> row(history.channels().size(), 0.0);
    const auto set = [&](const std::string& name, double value) {
      row[history.index(name)] = value;
    };
    set("time", x);
    set("stage", 2.0);
    set("x", x);
    set("force_z", 100.0);
    for (const auto& [name, rate] : rates) set(name, 7.0 + rate * x);
    history.append(row);
  }
  return measure_resistance(history).parts;
}

std::map<std::string, double> by_name(const std::vector<ResistancePart>& parts) {
  std::map<std::string, double> found;
  for (const ResistancePart& part : parts) found[part.name] = part.force;
  return found;
}

TEST(Resistance, PartsAreEnergiesOverTravelAndSumToTheWhole) {
  const ResistanceParts parts = parts_of(rates_of_all_parts());
  EXPECT_NEAR(parts.whole, 99.0, 1e-9);
  EXPECT_NEAR(parts.unexplained, 0.5, 1e-9);
  std::map<std::string, double> found = by_name(parts.parts);
  EXPECT_EQ(found.size(), 10u);  // no radiation
  EXPECT_NEAR(found["compaction"], 50.0, 1e-9);
  EXPECT_NEAR(found["wheel or tyre"], 4.0, 1e-9);
  EXPECT_NEAR(found["grid"], 4.0, 1e-9);
  EXPECT_NEAR(found["grains, pressed down"], 9.0, 1e-9);
  EXPECT_NEAR(found["grains, pushed along"], -2.0, 1e-9);
  EXPECT_NEAR(found["contact springs and damping"], 3.0, 1e-9);
  EXPECT_TRUE(parts.given_to_grains.empty());
  EXPECT_FALSE(measure_resistance(SyntheticRun().history()).parts.known());
}

TEST(Resistance, WorkOfGrainsIsDividedByPlace) {
  Rates rates = rates_of_all_parts();
  rates.insert({{"grains_below_work", 3.0},
                {"grains_ahead_work", 2.5},
                {"grains_aside_work", 1.0},
                {"grains_walls_work", 0.4},
                {"grains_lifted_work", -0.2},
                {"grains_kinetic_energy", 0.26}});  // 0.04 J/m of 7 are not found among the grains
  const ResistanceParts parts = parts_of(rates);
  std::map<std::string, double> found = by_name(parts.parts);
  EXPECT_NEAR(found["grains, below the track"], 3.0, 1e-9);
  EXPECT_NEAR(found["grains, ahead and aside"], 3.3, 1e-9);
  EXPECT_NEAR(found["grains, walls of the bed"], 0.4, 1e-9);
  EXPECT_NEAR(found["grains, their motion"], 0.26, 1e-9);
  EXPECT_EQ(found.count("grains, pressed down"), 0u);
  EXPECT_NEAR(parts.unexplained, 0.54, 1e-9);
  std::map<std::string, double> given = by_name(parts.given_to_grains);
  EXPECT_EQ(given.size(), 2u);
  EXPECT_NEAR(given["grains, pressed down"], 9.0, 1e-9);
  EXPECT_NEAR(given["grains, pushed along"], -2.0, 1e-9);
}

TEST(Resistance, IncompletePlacesOfGrainsAreNotShown) {
  Rates rates = rates_of_all_parts();
  rates.insert({{"grains_below_work", 3.0}, {"grains_ahead_work", 3.9}});  // of 7.0
  const ResistanceParts parts = parts_of(rates);
  std::map<std::string, double> found = by_name(parts.parts);
  EXPECT_EQ(found.count("grains, below the track"), 0u);
  EXPECT_NEAR(found["grains, pressed down"], 9.0, 1e-9);
  EXPECT_NEAR(parts.unexplained, 0.5, 1e-9);
}

// A slip that grows from 0 to 0.6, a pull of 100 N x slip with noise of 2 N: the stretches give the
// line, and errors of the noise alone.
TEST(Resistance, ErrorOfACurveExcludesItsTrend) {
  History history({{"time", "s", ""},
                   {"x", "m", ""},
                   {"hub_drop", "m", ""},
                   {"force_x", "N", ""},
                   {"force_z", "N", ""},
                   {"drawbar_pull", "N", ""},
                   {"drive_torque", "N m", ""},
                   {"slip", "", ""}});
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 2.0);
  constexpr int rows = 12000;
  for (int i = 0; i < rows; ++i) {
    const double slip = 0.6 * i / (rows - 1), pull = 100.0 * slip + noise(random);
    history.append({0.001 * i, 0.001 * i, 0.01, pull, 200.0, pull, 5.0, slip});
  }
  const std::vector<Resistance> curve = measure_curve(history, 6);
  ASSERT_EQ(curve.size(), 6u);
  for (std::size_t n = 0; n < curve.size(); ++n) {
    const double slip = 0.1 * static_cast<double>(n) + 0.05;
    const SteadyValue& pull = curve[n].value("drawbar_pull");
    EXPECT_NEAR(curve[n].value("slip").mean, slip, 1e-4);
    EXPECT_NEAR(pull.standard_error, 2.0 / std::sqrt(rows / 6.0), 0.3 * pull.standard_error);
    EXPECT_NEAR(pull.mean, 100.0 * slip, 4.0 * pull.standard_error);
  }
}

TEST(Resistance, ShortTravelIsReported) {
  ResistanceOptions options;
  options.shortest_distance = 20.0;
  const Resistance result = measure_resistance(SyntheticRun().history(), options);
  EXPECT_FALSE(result.steady);
  EXPECT_THAT(result.reasons, Contains(HasSubstr("the window is too short: the wheel travels")));
  EXPECT_THAT(result.reasons, Contains(HasSubstr("20 m are needed")));
}

TEST(Resistance, WindowByTimeIsUsed) {
  ResistanceOptions options;
  options.window.from_time = 4.0;
  options.window.to_time = 9.0;
  const Resistance result = measure_resistance(SyntheticRun().history(), options);
  EXPECT_NEAR(result.window.begin, 4.0, 1e-9);
  EXPECT_NEAR(result.window.end, 9.0, 1e-9);
  EXPECT_NEAR(result.window.distance, 5.0, 1e-9);
}

TEST(Resistance, RefusesHistoriesWithGapsOrWithoutCruise) {
  SyntheticRun gap;
  gap.skipped_from = 8.0;
  gap.skipped_to = 9.0;
  EXPECT_THAT(error_of([&] { measure_resistance(gap.history()); }),
              HasSubstr("rows of the history are not equally spaced"));
  SyntheticRun early;
  early.end = 1.5;
  EXPECT_THAT(error_of([&] { measure_resistance(early.history()); }),
              HasSubstr("ends before the cruise begins"));
  EXPECT_THAT(error_of([] {
                measure_resistance(History({{"time", "s", ""}}));
              }),
              HasSubstr("the history has 0 rows"));
  EXPECT_THAT(error_of([] { measure_resistance(SyntheticRun().history()).value("mass"); }),
              HasSubstr("no steady value 'mass'"));
}

TEST(Resistance, WheelWithoutLoadIsRefused) {
  SyntheticRun lifted;
  lifted.load = 0.0;
  EXPECT_THAT(error_of([&] { measure_resistance(lifted.history()); }),
              HasSubstr("the wheel carries no load in the window (cruise from 2 s"));
}

TEST(Resistance, RatioNeedsADenominator) {
  EXPECT_THAT(error_of([] {
                linearised_ratio({1.0, 2.0}, {1.0});
              }),
              HasSubstr("a ratio of 2 and 1 values"));
  EXPECT_THAT(error_of([] {
                linearised_ratio({1.0, 2.0}, {1.0, -1.0});
              }),
              HasSubstr("a ratio to a quantity whose mean is zero"));
  const std::vector<double> series = linearised_ratio({1.0, 3.0}, {2.0, 2.0});
  EXPECT_DOUBLE_EQ(0.5 * (series[0] + series[1]), 1.0);
}

}  // namespace
}  // namespace furrow::resistance_test

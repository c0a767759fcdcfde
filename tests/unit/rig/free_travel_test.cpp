// SPDX-License-Identifier: GPL-2.0-or-later
// A wheel that is free along x, on an inclined plane: Newton's and Coulomb's closed forms; and what
// the evaluation makes of wheels that get nowhere.

#include "furrow/statistics/free_travel.h"

#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "furrow/statistics/resistance.h"
#include "made_again.h"
#include "tests/support/error_of.h"
#include "wheel_on_floor.h"

namespace furrow::free_travel_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

constexpr double g = 9.80665, radius = 0.2, inertia = 0.06;  // of make_wheel()
constexpr double dt = 1e-4;                                  // [s]

const std::string free_rig =
    " travel free settle_time 0.4 accelerate_time 0.2 ground_level 0 damping 600";

/// The history of a run, a row for every fifth step.
History history_of(const std::string& line, const Floor& floor, double end, int segments = 80) {
  RigidWheel wheel = make_wheel(0.2003, segments);
  WheelRig rig = rig_of(wheel, line + free_rig);
  History history(WheelRig::channels());
  long step = 0;
  run(rig, wheel, end, dt, &floor, [&](const std::vector<double>& row) {
    if (++step % 5 == 0) history.append(row);
  });
  // the wheel's own energy closes, and load and drive are all that it got
  const EnergyBudget budget = wheel.energy_budget();
  EXPECT_NEAR(budget.residual(), 0.0,
              1e-10 * (std::abs(budget.load_work) + std::abs(budget.drive_work)));
  return history;
}

/// Mean over the second half of the cruise: single rows know the facets of the wheel.
double mean(const History& history, const std::string& name) {
  const std::vector<double> column = history.column(name);
  const std::size_t first = (first_row_of_cruise(history) + history.size()) / 2;
  return std::accumulate(column.begin() + static_cast<std::ptrdiff_t>(first), column.end(), 0.0) /
         static_cast<double>(history.size() - first);
}

/// Sticks less than a floor should, for the sake of longer steps.
Floor floor_of(double friction, double creep = 5e-3) {
  Floor floor;
  floor.friction = friction;
  floor.creep = creep;
  return floor;
}

/// Mean acceleration in the cruise [m/s^2].
double acceleration(const History& history) {
  const std::vector<double> time = history.column("time"), v = history.column("velocity_x");
  const std::size_t first = first_row_of_cruise(history);
  return (v.back() - v[first]) / (time.back() - time[first]);
}

struct Hill {
  std::string name;
  double slope;     // [degrees]
  double mass;      // [kg] that moves along x
  double friction;  // of the floor
  std::string mode;
  double a;  // [m/s^2] closed form
};

// Rolling without slip: a = -g sin/(1 + I/(m r^2)); sliding: a = -(g sin -+ mu g cos).
TEST(FreeTravel, InclinedPlaneGivesTheClosedFormAccelerations) {
  const auto sine = [](double slope) { return std::sin(radians(slope)); };
  const auto cosine = [](double slope) { return std::cos(radians(slope)); };
  const double m = 6.0, rolling = 1.0 + inertia / (m * radius * radius);
  const std::vector<Hill> hills = {
      {"rolls down", -10, m, 0.5, "mode towed", g * sine(10) / rolling},
      {"rolls back down", 10, m, 0.5, "mode towed", -g * sine(10) / rolling},
      {"without friction", -10, m, 0.0, "mode towed", g * sine(10)},
      {"locked", -20, m, 0.1, "mode spin spin_rate 0", g * (sine(20) - 0.1 * cosine(20))},
      // rolls and slides: tan 30 degrees > mu (1 + m r^2/I)
      {"slips", -30, m, 0.05, "mode towed", g * (sine(30) - 0.05 * cosine(30))},
      {"spins uphill", 3, m, 0.1, "mode spin spin_rate 100", g * (0.1 * cosine(3) - sine(3))},
      {"torque on the level", 0, m, 0.5, "mode torque torque 1", 1.0 / radius / (m * rolling)},
      {"heavier than its load", 0, 12.0, 0.5, "mode torque torque 1 dragged_mass 12",
       1.0 / radius / (12.0 + inertia / (radius * radius))},
  };
  for (const Hill& hill : hills) {
    SCOPED_TRACE(hill.name);
    const History history =
        history_of(fmt::format("{} load_mass 6 slope {}", hill.mode, hill.slope),
                   floor_of(hill.friction), 1.4, 160);
    EXPECT_NEAR(acceleration(history), hill.a,
                hill.friction == 0.0 ? 1e-9 : 0.02 * std::abs(hill.a));
    // the ground carries the part of the weight that is normal to it
    EXPECT_NEAR(mean(history, "force_z"), m * g * cosine(hill.slope), 1.5);
    // the pull is the ground's force less the wheel's own inertia
    EXPECT_NEAR(mean(history, "drawbar_pull"),
                m * g * sine(hill.slope) + (hill.mass - 3.0) * acceleration(history), 0.02 * m * g);
  }
}

// Friction that is viscous below 1 mm/s: F = mu N v_slip/creep, so a drawbar load D is in
// equilibrium at v = u - creep D/(mu N); the rig at that slip measures the pull D.
TEST(FreeTravel, DrawbarLoadSetsTheSlipOfItsPull) {
  const Floor floor = floor_of(0.5, 0.2);
  const History free =
      history_of("load_force 60 mode spin spin_rate 5 drawbar_load 12", floor, 3.0);
  const double rim = 5.0 * radius, v = rim - floor.creep * 12.0 / (0.5 * 60.0);
  EXPECT_NEAR(mean(free, "velocity_x"), v, 2e-3 * v);
  EXPECT_NEAR(mean(free, "drawbar_pull"), 12.0, 0.05);
  EXPECT_EQ(judge_travel(free, first_row_of_cruise(free)).travel, Travel::travels);

  RigidWheel wheel = make_wheel(0.2003);
  WheelRig rig = rig_of(wheel, fmt::format("load_force 60 mode slip slip {} speed {} settle_time "
                                           "0.4 accelerate_time 0.2 ground_level 0 damping 600",
                                           mean(free, "slip"), v));
  History prescribed(WheelRig::channels());
  run(rig, wheel, 3.0, dt, &floor, [&](const std::vector<double>& row) { prescribed.append(row); });
  EXPECT_NEAR(mean(prescribed, "drawbar_pull"), 12.0, 0.15);
}

// A slope is a drawbar load: W sin(slope) under W cos(slope).
TEST(FreeTravel, SlopeAndDrawbarLoadAreEquivalent) {
  const Floor floor = floor_of(0.5, 0.2);
  const double slope = radians(8.0), weight = 60.0;
  const History hill = history_of("load_force 60 mode spin spin_rate 5 slope 8", floor, 2.0);
  const History level =
      history_of(fmt::format("load_force {} mode spin spin_rate 5 drawbar_load {} dragged_mass {}",
                             weight * std::cos(slope), weight * std::sin(slope), weight / g),
                 floor, 2.0);
  for (const char* name : {"slip", "velocity_x", "drawbar_pull", "force_z", "drive_torque"})
    EXPECT_NEAR(mean(hill, name), mean(level, name), 2e-3 * std::abs(mean(level, name)) + 1e-4)
        << name;
}

TEST(FreeTravel, StalledWheelIsFlaggedAndExcludedFromMean) {
  struct Case {
    std::string line;
    double friction;
    Travel travel;
    std::string said;
  };
  const std::vector<Case> cases = {
      {"mode towed slope -10", 0.5, Travel::runs_away, "the wheel runs away"},
      {"mode torque torque 12", 0.3, Travel::runs_away, "the wheel runs away"},
      {"mode torque torque 12 drawbar_load 18", 0.3, Travel::runs_away, "the wheel spins away"},
      {"mode spin spin_rate 5 drawbar_load 29.9", 0.5, Travel::travels, ""},
      // the floor of the test creeps
      {"mode spin spin_rate 0 slope 10", 0.5, Travel::rolls_back, "the wheel rolls back"},
  };
  for (const Case& each : cases) {
    SCOPED_TRACE(each.said);
    const History history = history_of(each.line + " load_force 60", floor_of(each.friction), 1.4);
    const TravelVerdict verdict = judge_travel(history, first_row_of_cruise(history));
    EXPECT_EQ(verdict.travel, each.travel) << verdict.sentence;
    EXPECT_THAT(verdict.sentence, HasSubstr(each.said));
    if (each.travel == Travel::travels) continue;
    EXPECT_THAT(error_of([&] { measure_resistance(history); }), HasSubstr(each.said));
    ResistanceOptions options;  // who names a window, takes the mean
    options.window.from_time = 1.0;
    EXPECT_NO_THROW(measure_resistance(history, options));
  }
}

/// Speeds and sinkage in the cruise as functions of its time [s].
History made_up(double (*axle)(double), double (*rim)(double), double (*sinkage)(double)) {
  History history({{"time", "s", ""},
                   {"stage", "", ""},
                   {axle_free_channel, "", ""},
                   {"velocity_x", "m/s", ""},
                   {"rim_speed", "m/s", ""},
                   {"hub_drop", "m", ""}});
  for (int i = 0; i < 400; ++i) {
    const double t = 0.01 * i, ripple = 1.0 + 0.02 * std::sin(37.0 * t);
    history.append({t, 2.0, 1.0, axle(t) * ripple, rim(t), sinkage(t) * ripple});
  }
  return history;
}

TEST(FreeTravel, VerdictsFollowSpeedsAndSinkage) {
  const auto constant = [](double) { return 0.02; };
  const auto judge = [](const History& history) { return judge_travel(history, 0).travel; };
  EXPECT_EQ(judge(made_up([](double) { return 0.2; }, [](double) { return 0.3; }, constant)),
            Travel::travels);
  EXPECT_EQ(judge(made_up([](double) { return 0.05; }, [](double) { return 0.3; },
                          [](double t) { return 0.02 * (1.0 + 0.2 * t); })),
            Travel::digs_in);
  EXPECT_EQ(judge(made_up([](double) { return 0.01; }, [](double) { return 0.3; }, constant)),
            Travel::stalled);
  EXPECT_EQ(judge(made_up([](double t) { return 0.3 * std::exp(-8.0 * t); },
                          [](double) { return 0.0; }, constant)),
            Travel::stalled);
  EXPECT_EQ(judge(made_up([](double) { return -0.1; }, [](double) { return 0.3; }, constant)),
            Travel::rolls_back);
  EXPECT_EQ(
      judge(made_up([](double t) { return 0.3 * t; }, [](double t) { return 0.3 * t; }, constant)),
      Travel::runs_away);
  // approaches its speed
  EXPECT_EQ(judge(made_up([](double t) { return 0.3 * (1.0 - std::exp(-2.0 * t)); },
                          [](double) { return 0.3; }, constant)),
            Travel::travels);
}

TEST(FreeTravel, RestartContinuesBitwise) {
  expect_continues_bitwise("load_mass 6 slope 5 mode torque torque 3" + free_rig, Floor(), 5000,
                           8000);
}

TEST(FreeTravel, ContradictingKeywordsAreRefused) {
  const std::string stages = " settle_time 0.2 accelerate_time 0.2 ground_level 0";
  const std::vector<std::pair<std::string, std::string>> table = {
      {"load_force 60 mode towed", "keyword 'speed' is missing with travel prescribed"},
      {"load_force 60 mode towed travel free speed 1", "keyword 'speed' is given with travel free"},
      {"load_force 60 mode towed speed 1 drawbar_load 5",
       "keyword 'drawbar_load' is given with travel prescribed; allowed: only with travel free"},
      {"load_force 60 mode towed speed 1 dragged_mass 5",
       "keyword 'dragged_mass' is given with travel prescribed"},
      {"load_force 60 mode slip slip 0.2 travel free",
       "keyword 'mode' is slip with travel free; allowed: towed, torque or spin"},
      {"load_force 60 mode spin travel free", "keyword 'spin_rate' is missing in mode spin"},
      {"load_force 60 mode towed speed 1 spin_rate 5",
       "keyword 'spin_rate' is given in mode towed"},
      {"sinkage 0.01 mode towed travel free", "keyword 'travel' is free with a prescribed sinkage"},
      {"load_force 60 mode towed travel free dragged_mass 1",
       "keyword 'dragged_mass' is 1 kg; allowed: at least 3 kg, the mass of the wheel"},
      {"load_force 60 mode towed travel free drawbar_load 1e5",
       "keyword 'drawbar_load' is 100000 N under a load of 60 N"},
      {"load_force 60 mode towed travel free slope 60",
       "keyword 'slope' is 60; allowed: a number in [-45, 45] [degrees]"},
  };
  for (const auto& [line, said] : table) {
    RigidWheel wheel = make_wheel();
    EXPECT_THAT(error_of<InputError>([&, &line = line] { rig_of(wheel, line + stages); }),
                HasSubstr(said));
  }
}

}  // namespace
}  // namespace furrow::free_travel_test

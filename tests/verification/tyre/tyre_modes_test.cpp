// SPDX-License-Identifier: GPL-2.0-or-later
// Natural modes of a tyre: those of a body of revolution, and the vibrations that the tyre itself
// makes in time.

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../unit/tyre/tyres.h"
#include "furrow/io/inputs/brick_tyre_file.h"
#include "tests/support/error_of.h"
#include "furrow/tyre/brick/brick_tyre.h"
#include "furrow/tyre/darnell/darnell_tyre.h"
#include "furrow/tyre/mode_kind.h"

namespace furrow::test::tyre_modes_test {
namespace {

// little air, so that the belt has no wrinkles
constexpr double pressure = 20e3;  // [Pa]

DarnellTyre inflated(bool half = false) {
  DarnellTyreSettings settings = coarse(half);
  settings.sidewall_rows = 0;
  settings.damping_rate = 0.0;
  DarnellTyre tyre(p235(pressure), settings, {{30.0, 1.0, 0.6}, Vector3::Zero()});
  SettleOptions precisely;
  precisely.tolerance = 1e-6;
  tyre.settle(nullptr, precisely);
  return tyre;
}

/// Turning about the axle, moving along it, shaking along it and across, each of the last two in
/// two directions: the order that measured tyres have as well.
TEST(TyreModes, BodyOfRevolutionHasPairedModes) {
  DarnellTyre tyre = inflated();
  const NaturalModes modes = tyre.natural_modes(nullptr, 10);
  EXPECT_LT(modes.asymmetry, 1e-5);
  const int waves[] = {0, 0, 1, 1, 1, 1, 2, 2, 2, 2};
  for (int i = 0; i < 10; ++i) {
    const ModeKind kind = kind_of(tyre, modes.shape[static_cast<std::size_t>(i)]);
    EXPECT_EQ(kind.waves, waves[i]) << i;
    EXPECT_GT(kind.wave_share, 0.999) << i;
    EXPECT_NEAR(kind.radial + kind.circumferential + kind.axial, 1.0, 1e-12) << i;
  }
  for (int i = 3; i < 10; i += 2)
    EXPECT_NEAR(modes.frequency[i] / modes.frequency[i - 1], 1.0, 1e-5) << i;
  EXPECT_GT(kind_of(tyre, modes.shape[0]).circumferential, 0.999);
  EXPECT_GT(kind_of(tyre, modes.shape[1]).axial, 0.99);
  EXPECT_GT(kind_of(tyre, modes.shape[2]).axial, 0.9);
}

TEST(TyreModes, TyreOfBricksHasPairedModes) {
  BrickTyreParameters parameters =
      read_brick_tyre_file(std::string(FURROW_SOURCE_DIR) + "/inputs/tyres/p235_75r15_smooth.yaml");
  parameters.pressure = 100e3;
  BrickTyreSettings settings;
  settings.sections = 36;
  settings.damping_rate = 0.0;
  BrickTyre tyre(parameters, settings, {{30.0, 1.0, 0.6}, Vector3::Zero()});
  tyre.settle(nullptr);
  const NaturalModes modes = tyre.natural_modes(nullptr, 6);
  const int waves[] = {0, 0, 1, 1, 1, 1};
  for (int i = 0; i < 6; ++i) {
    const ModeKind kind = kind_of(tyre, modes.shape[static_cast<std::size_t>(i)]);
    EXPECT_EQ(kind.waves, waves[i]) << i;
    EXPECT_GT(kind.wave_share, 0.999) << i;
  }
  for (int i = 3; i < 6; i += 2)
    EXPECT_NEAR(modes.frequency[i] / modes.frequency[i - 1], 1.0, 1e-5) << i;
}

/// The tyre is hit in the shape of a mode and left alone; the period is the time between crossings
/// of the rest position.
TEST(TyreModes, FreeVibrationHasTheModalFrequencies) {
  for (const std::size_t mode : {0u, 4u}) {  // turning; shaking in the wheel's plane
    DarnellTyre tyre = inflated();
    const NaturalModes modes = tyre.natural_modes(nullptr, 5);
    const double frequency = modes.frequency[static_cast<Eigen::Index>(mode)];
    const Matrix3X weighted = modes.shape[mode] * tyre.tread().mass.asDiagonal();
    const Matrix3X rest = tyre.tread().x;
    const double dt = tyre.stable_time_step();
    const double speed = 1e-4 * 2.0 * pi * frequency;  // [m/s] for an amplitude of 0.1 mm
    tyre.surface().f.leftCols(rest.cols()) = speed / dt * weighted;
    tyre.advance(dt);
    tyre.surface().clear_forces();

    std::vector<double> crossings;  // [s]
    double before = 0.0;
    for (long step = 1; crossings.size() < 5; ++step) {
      ASSERT_LT(step * dt, 4.0 / frequency);
      tyre.advance(dt);
      const double now = (tyre.tread().x - rest).cwiseProduct(weighted).sum();
      if (before != 0.0 && (now > 0.0) != (before > 0.0))
        crossings.push_back(dt * (static_cast<double>(step) - now / (now - before)));
      before = now;
    }
    const double found = 2.0 / (crossings[4] - crossings[0]);
    EXPECT_NEAR(found / frequency, 1.0, 0.003) << mode;
  }
}

TEST(TyreModes, StandingTyreIsFixedAtTheContact) {
  DarnellTyre tyre = inflated();
  const double free = tyre.natural_modes(nullptr, 1).frequency[0];
  RigidPlaneParameters floor;
  floor.height = tyre.lowest_tread_height();
  RigidPlane plane(floor, tyre.surface());
  tyre.release(Coordinate::z);
  tyre.set_load({0.0, 0.0, -1500.0});
  tyre.settle(&plane);
  const Matrix3X before = tyre.tread().x;
  const NaturalModes modes = tyre.natural_modes(&plane, 3);
  EXPECT_EQ((tyre.tread().x - before).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_GT(modes.frequency[0], free);
  int held = 0;
  for (int node = 0; node < tyre.tread_grid().count(); ++node)
    if (plane.pressure()[node] > 0.0) {
      ++held;
      EXPECT_EQ(modes.shape[0].col(node).norm(), 0.0);
    }
  EXPECT_GE(held, 4);
}

TEST(TyreModes, HalfModelIsRefused) {
  DarnellTyre tyre = inflated(true);
  EXPECT_THAT(error_of([&] { tyre.natural_modes(nullptr, 3); }),
              testing::HasSubstr("is a half model"));
}

}  // namespace
}  // namespace furrow::test::tyre_modes_test

// SPDX-License-Identifier: GPL-2.0-or-later
// Limits of a thin belt: little air under much load, a crowned tread, a tread that buckles inside
// its shoulder. The tyre settles, or the error gives the reason; what is tested are balances and
// orders that hold for any tyre.

#include <cmath>
#include <functional>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../unit/tyre/tyres.h"
#include "furrow/core/error.h"
#include "furrow/tyre/contact_patch.h"
#include "furrow/tyre/darnell/darnell_tyre.h"
#include "tests/support/error_of.h"

namespace furrow::tyre_hard_cases_test {
namespace {

using ::testing::HasSubstr;

struct Rest {
  double deflection, width, chord, residual, tilt;
  ContactPatch patch;
  // [Pa] mean pressure of the tread's lines from the middle to the edge, in the middle of the print
  std::vector<double> lines;
};

/// At rest on a smooth plane; half model. @param edit changes the tyre file's parameters
Rest press(double pressure, double load, int across, int around,
           const std::function<void(TyreParameters&)>& edit = {}) {
  TyreParameters parameters = p235(pressure);
  if (edit) edit(parameters);
  DarnellTyreSettings settings;
  settings.across = across;
  settings.around = around;
  settings.half = true;
  settings.sidewall_rows = 0;
  DarnellTyre tyre(parameters, settings, {{30.0, 1.0, 0.6}, Vector3::Zero()});
  tyre.settle(nullptr);
  RigidPlaneParameters floor;
  floor.height = tyre.tread().x.row(2).minCoeff();
  RigidPlane plane(floor, tyre.surface());
  tyre.release(Coordinate::z);
  tyre.set_load({0.0, 0.0, -load});
  const Relaxation result = tyre.settle(&plane);
  tyre.surface().clear_forces();
  plane.press_on(tyre.surface());
  std::vector<double> lines;
  for (int j = 0; j < tyre.tread_grid().lines(); ++j) {
    double sum = 0.0;
    for (int i = -1; i <= 1; ++i) sum += plane.pressure()[tyre.tread_grid().node(i, j)];
    lines.push_back(sum / 3.0);
  }
  return {-tyre.centre().z(),
          tyre.section_width(),
          tyre.largest_sidewall_chord(),
          result.residual,
          tyre.ground_wrench().moment.y(),
          contact_patch(tyre, plane),
          lines};
}

/// 69 kPa under 5 kN: half of the way from tread to rim is used. The print carries the air's
/// pressure and what sidewalls and belts add; the profile bulges.
TEST(HardCases, LowPressureUnderHighLoadIsSolved) {
  constexpr double little = 69e3, load = 5000.0;
  const Rest rest = press(little, load, 4, 36), full = press(241e3, load, 4, 36);
  EXPECT_NEAR(rest.patch.force, load, 8.0);
  EXPECT_GT(rest.deflection, 0.06);
  EXPECT_LT(rest.deflection, 0.1395);  // tread radius less bead radius
  EXPECT_GT(rest.deflection, 2.5 * full.deflection);
  EXPECT_GT(rest.width, full.width + 0.015);
  EXPECT_GT(rest.patch.mean_pressure, little);
  EXPECT_LT(rest.patch.mean_pressure, 2.0 * little);
  EXPECT_LT(rest.chord, 1.0);
}

/// The tread comes down on the rim: the chain has no table there, and the error says where and what
/// was left.
TEST(HardCases, TreadOnTheRimStopsTheRun) {
  EXPECT_THAT(test::error_of<StateError>([&] { press(69e3, 9000.0, 4, 36); }),
              ::testing::AllOf(HasSubstr("sidewall at +y, station"), HasSubstr("chord")));
}

/// A crowned tread touches with its middle. Under its full load the barrel, which is curved both
/// ways, snaps through: the middle of the print lifts, the tread carries at the front and the rear
/// of it, and the tyre settles all the same.
TEST(HardCases, CrownedTreadSettles) {
  const auto crown = [](TyreParameters& tyre) { tyre.tread.crown = 0.01; };
  const Rest light = press(103e3, 600.0, 6, 72, crown), heavy = press(103e3, 6227.0, 6, 72, crown),
             flat = press(103e3, 6227.0, 6, 72);
  EXPECT_GT(light.lines.front(), 103e3);
  EXPECT_EQ(light.lines[2] + light.lines[3], 0.0);
  EXPECT_EQ(light.patch.lifted_share, 0.0);
  EXPECT_GT(heavy.patch.lifted_share, 0.2);
  EXPECT_LT(flat.patch.lifted_share, 0.05);
  EXPECT_LT(heavy.patch.perimeter_area, 0.8 * flat.patch.perimeter_area);
  EXPECT_GT(heavy.deflection, flat.deflection);
  EXPECT_NEAR(light.patch.force, 600.0, 2.0);
  for (const Rest* rest : {&heavy, &flat}) {
    EXPECT_NEAR(rest->patch.force, 6227.0, 8.0);
    EXPECT_LT(rest->residual, 1e-3);
    EXPECT_LT(std::abs(rest->tilt), 5e-3 * rest->patch.force * 0.3475);  // symmetric fore and aft
  }
}

/// A sidewall that is held stiffly to the tread's edge presses the edge down and buckles the belt
/// inside it, as [Shoop2001] Figs 52 and 53 show: the shoulder carries much more than the air's
/// pressure, the line of nodes inside it much less, the middle the air's pressure.
TEST(HardCases, StiffTreadJointBucklesTheBeltInsideTheShoulder) {
  constexpr double pressure = 207e3;
  const Rest pinned = press(pressure, 6627.0, 6, 72),
             held = press(pressure, 6627.0, 6, 72,
                          [](TyreParameters&tyre) { tyre.sidewall.tread_stiffness = 50.0; });
  EXPECT_NEAR(held.patch.force, 6627.0, 8.0);
  EXPECT_LT(held.residual, 1e-3);
  EXPECT_LT(held.lines[2], 0.7 * pressure);
  EXPECT_GT(held.lines[3], 1.5 * pressure);
  EXPECT_GT(held.lines[3], pinned.lines[3] + 0.3 * pressure);
  EXPECT_GT(held.patch.largest_pressure, pinned.patch.largest_pressure);
  EXPECT_NEAR(held.deflection / pinned.deflection, 1.0, 0.05);
}

}  // namespace
}  // namespace furrow::tyre_hard_cases_test

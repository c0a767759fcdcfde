// SPDX-License-Identifier: GPL-2.0-or-later
// A thin blade in cohesive ground, with and without ground that it divides.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../../unit/mpm/terrain_scene.h"
#include "furrow/bodies/rigid_plate.h"
#include "tests/support/bar.h"

namespace furrow::thin_blade_test {
namespace {

using namespace testing_terrain;

struct Blade {
  int cells;     // per height
  double place;  // in its cell
  bool thin_parts;
};

/// Forces on the two faces of the blade, over Rankine's, and the audit.
struct Pushed {
  double front = 0.0, rear = 0.0;
  double residual, contact_work;  // [J]
  double net() const { return front + rear; }
};

/// A smooth blade goes sideways by a twentieth of its height through weightless clay, in plane
/// strain: a slice of one cell. Mises, d = sqrt(3) c, E/c = 1000. Forces are means of the last
/// third.
Pushed push(const Blade& blade) {
  constexpr double H = 0.3, c = 1e4, speed = 0.03, travel = 0.05 * H, interval = 2e-3;
  const double cell = H / blade.cells;
  const auto whole = [&](double heights) { return std::ceil(heights * blade.cells) * cell; };
  const Vector3 lower(-whole(2), 0, -whole(2.2)), upper(whole(5), cell, 0);
  TerrainParameters p =
      box(material_of(fmt::format(
              "drucker_prager_cap density 2000 d {} beta 0.001 R 0.1 elasticity linear E 1e7 nu "
              "0.3 hardening table p 1e9 2e9 eps_vol_pl 0 1 interpolation linear beyond "
              "extrapolate",
              std::sqrt(3.0) * c)),
          lower, upper, cell);
  p.z = even(lower.z(), whole(0.7), cell);
  p.particles_per_cell = {2, 1, 2};
  p.thin_parts = blade.thin_parts;
  set_boundary(p, {"smooth", "smooth", "smooth", "smooth", "rough", "free"});
  ContinuumTerrain ground(p, Communicator());
  // so thin that it touches no particle at the start
  RigidPlate plate({PlateShape::square, 1.0, 1.0, 4}, test::bar({2e-4 * cell, 3 * cell, 1.5 * H}),
                   {blade.place * cell, 0.5 * cell, -H});
  ContactParameters smooth;
  smooth.friction = 0.0;
  TerrainContact contact(plate, ground, smooth, false, "blade");
  CoupledSystem system;
  system.add(plate, "blade");
  system.add(ground, "ground");
  system.add(contact, "touch");
  Pushed pushed;
  double time = 0.0, moved = 0.0, count = 0.0;
  while (moved < travel) {
    const double v = speed * std::min(1.0, time / (0.2 * travel / speed));
    plate.prescribe(Vector3(v, 0, 0));
    system.advance(interval);
    time += interval;
    moved += v * interval;
    if (moved < 2.0 / 3.0 * travel) continue;
    system.publish_contact_forces();
    for (int n = 0; n < 8; ++n) {
      double& face = plate.surface().x(0, n) > plate.centre().x() ? pushed.front : pushed.rear;
      face -= plate.surface().f(0, n) / (2 * c * H * cell);
    }
    count += 1.0;
  }
  pushed.front /= count;
  pushed.rear /= count;
  const EnergyBudget budget = ground.energy_budget();
  pushed.residual = budget.residual();
  pushed.contact_work = budget.contact_work;
  return pushed;
}

/// W. J. M. Rankine (1857): the passive pressure of weightless cohesive ground on a smooth upright
/// wall is 2 c. The rear carries nothing. The answer comes from above, with the cell, wherever the
/// blade is in it.
TEST(ThinBlade, BladeForceConvergesToRankineAnywhereInACell) {
  for (const double place : {0.0, 0.5}) {
    const Pushed coarse = push({3, place, true}), fine = push({6, place, true});
    RecordProperty(fmt::format("force_at_{}", place),
                   fmt::format("{:.3f} with 3 cells, {:.3f} with 6", coarse.net(), fine.net()));
    EXPECT_NEAR(coarse.net(), 1.23, 0.02) << place;
    EXPECT_NEAR(fine.net(), 1.15, 0.02) << place;
    for (const Pushed& pushed : {coarse, fine}) {
      EXPECT_NEAR(pushed.rear, 0.0, 0.01) << place;
      EXPECT_LT(std::abs(pushed.residual), 1e-3 * pushed.contact_work) << place;
    }
  }
}

/// Through the grid the blade pulls the ground behind it, and the springs of both faces press on
/// each other.
TEST(ThinBlade, UndividedGroundIsPulledBehindTheBlade) {
  const Pushed pushed = push({3, 0.5, false});
  RecordProperty("force", fmt::format("front {:.3f}, rear {:.3f}", pushed.front, pushed.rear));
  EXPECT_GT(pushed.net(), 2.0);
}

}  // namespace
}  // namespace furrow::thin_blade_test

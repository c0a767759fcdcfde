// SPDX-License-Identifier: GPL-2.0-or-later
// On a rigid plane the resistance of a sliding wheel is friction alone: mu N |u - v|/v, u the speed
// of the rim, v that of the axle.

#include "furrow/statistics/resistance_parts.h"

#include <cmath>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "furrow/bodies/rigid_plane.h"
#include "wheel_on_floor.h"

namespace furrow::resistance_parts_test {
namespace {

TEST(ResistanceParts, SlidingWheelOnARigidPlaneLosesItsEnergyToFriction) {
  const double dt = 1e-4, mu = 0.5, load = 60.0, v = 1.0;
  for (const double slip : {0.3, -0.5, -1.0}) {
    SCOPED_TRACE(slip);
    RigidWheel wheel = make_wheel(0.2003, 160);
    WheelRig rig =
        rig_of(wheel, fmt::format("load_force 60 speed 1 mode slip slip {} settle_time 0.3 "
                                  "accelerate_time 0.1 ground_level 0 damping 600",
                                  slip));
    RigidPlane plane({0.0, 3e8, 0.0, mu, 1e8}, wheel.surface());
    History history(WheelRig::channels());
    for (long i = 0; i < 10000; ++i) {
      rig.apply(static_cast<double>(i) * dt, dt);
      wheel.advance(dt);
      wheel.surface().clear_forces();
      plane.press_on(wheel.surface());
      GroundLosses losses;
      losses.friction = plane.friction_loss();
      history.append(rig.measure(static_cast<double>(i + 1) * dt, losses));
    }
    const ResistanceParts parts = resistance_parts(history, select_window(history, {}, {"slip"}));
    std::map<std::string, double> force;
    for (const ResistancePart& part : parts.parts) force[part.name] = part.force;
    const double friction = mu * load * std::abs(rig.target_rim_speed() - v) / v;
    EXPECT_NEAR(force["friction of wheel and ground"], friction, 0.01 * friction);
    EXPECT_NEAR(parts.whole, friction, 0.01 * friction);
    EXPECT_NEAR(parts.unexplained, 0.0, 0.01 * friction);
  }
}

}  // namespace
}  // namespace furrow::resistance_parts_test

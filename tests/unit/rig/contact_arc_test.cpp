// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/rig/contact_arc.h"

#include <cmath>

#include <gtest/gtest.h>

#include "wheel_on_floor.h"

namespace furrow::contact_arc_test {
namespace {

constexpr std::size_t sectors = 90;
constexpr double degree = pi / 180.0, radius = 0.2, width = 0.1;  // of make_wheel()

/// On the rim, in the wheel's own directions: forward, to the left, up.
struct Directions {
  Vector3 forward, left, up;
  explicit Directions(const RigidWheel& wheel)
      : forward(wheel.axle().cross(Vector3::UnitZ()).normalized()),
        left(wheel.axle()),
        up(forward.cross(left)) {}
  Vector3 outward(double angle) const { return std::sin(angle) * forward - std::cos(angle) * up; }
  Vector3 along(double angle) const { return std::cos(angle) * forward + std::sin(angle) * up; }
};

// A pressure p0 cos(theta) over 40 degrees ahead and a third of it as shear, on a wheel that stands
// askew, from points all over its width.
TEST(ContactArc, StressesAndSlipOfAnyForces) {
  for (const double yaw : {0.0, 0.3}) {
    RigidWheel wheel = make_wheel();
    wheel.place({1.0, -2.0, 0.2}, yaw, 0.1);
    const Directions at(wheel);
    ContactArc arc(wheel, sectors);
    constexpr double p0 = 1e5, dt = 0.01, fine = 0.1 * degree;
    for (int step = 0; step < 3; ++step)
      for (double angle = 0.5 * fine; angle < 40.0 * degree; angle += fine)
        for (const double y : {-0.5 * width, 0.1 * width}) {
          const double pressure = p0 * std::cos(angle);
          const double area = 0.5 * radius * fine * width;
          const Vector3 point = wheel.centre() + radius * at.outward(angle) + y * at.left;
          const Vector3 force =
              area * pressure * (-at.outward(angle) + at.along(angle) / 3.0) + 7.0 * at.left;
          arc.add(point, force, -0.2 * angle * at.along(angle) + 0.4 * at.outward(angle), dt);
        }
    const ContactArc::Profile found = arc.profile(arc.sums(), 3 * dt);
    ASSERT_EQ(found.angle.size(), sectors);
    for (std::size_t s = 0; s < sectors; ++s) {
      const double angle = found.angle[s];
      EXPECT_NEAR(angle, (2.0 * double(s) + 1.0 - 90.0) * degree, 1e-12);
      const bool touches = angle > 0.0 && angle < 40.0 * degree;
      const double pressure = touches ? p0 * std::cos(angle) : 0.0;
      EXPECT_NEAR(found.normal[s], pressure, 1e-4 * p0) << angle / degree;
      EXPECT_NEAR(found.shear[s], pressure / 3.0, 1e-4 * p0) << angle / degree;
      EXPECT_NEAR(found.slip[s], touches ? 0.2 * angle : 0.0, 1e-4) << angle / degree;
    }
  }
}

TEST(ContactArc, ForcesAboveTheAxleAreExcluded) {
  RigidWheel wheel = make_wheel();
  ContactArc arc(wheel, sectors);
  const Directions at(wheel);
  for (const double angle : {-100.0, 91.0, 180.0})
    arc.add(wheel.centre() + radius * at.outward(angle * degree), Vector3::UnitZ(),
            Vector3::UnitX(), 1.0);
  for (const double sum : arc.sums()) EXPECT_EQ(sum, 0.0);
}

}  // namespace
}  // namespace furrow::contact_arc_test

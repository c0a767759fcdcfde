// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/rig/suspension.h"

#include <cmath>

#include <gtest/gtest.h>

#include "furrow/core/types.h"

namespace furrow::suspension_test {
namespace {

constexpr double mass = 50.0, stiffness = 8000.0, dt = 1e-4;  // [kg], [N/m], [s]
const double frequency = std::sqrt(stiffness / mass);         // [rad/s]

double damping_of(double ratio) { return 2.0 * ratio * std::sqrt(stiffness * mass); }

// A weight W put on the mass over a held axle:
// s = -W/k (1 - exp(-z w t) (cos(w_d t) + z w/w_d sin(w_d t))).
TEST(Suspension, TheMassOnAHeldAxleSwingsWithItsNaturalFrequencyAndDamping) {
  for (const double ratio : {0.0, 0.1, 0.4}) {
    Suspension suspension(stiffness, damping_of(ratio), mass);
    const double weight = 400.0, damped = frequency * std::sqrt(1.0 - ratio * ratio);
    for (int i = 0; i < 20000; ++i) {
      suspension.advance(0.0, 0.0, weight, dt);
      const double t = (i + 1) * dt;
      const double decay = std::exp(-ratio * frequency * t);
      const double expected = -weight / stiffness *
                              (1.0 - decay * (std::cos(damped * t) +
                                              ratio * frequency / damped * std::sin(damped * t)));
      ASSERT_NEAR(suspension.height(), expected, 2e-3 * weight / stiffness) << ratio << " " << t;
    }
  }
}

// A washboard moves the axle: the amplitude of the mass over that of the axle is
// sqrt((1 + (2 z r)^2)/((1 - r^2)^2 + (2 z r)^2)), r the frequency over the natural one.
TEST(Suspension, AWashboardMovesTheMassByTheTransmissibility) {
  const double ratio = 0.25, amplitude = 0.01;
  for (const double r : {0.5, 1.0, 2.0}) {
    Suspension suspension(stiffness, damping_of(ratio), mass);
    const double w = r * frequency;
    const int begin = 40000, end = begin + static_cast<int>(2.0 * pi / w / dt);
    double largest = 0.0;
    for (int i = 0; i < end; ++i) {
      const double t = i * dt;
      suspension.advance(amplitude * std::sin(w * t), amplitude * w * std::cos(w * (t - 0.5 * dt)),
                         0.0, dt);
      if (i >= begin) largest = std::max(largest, std::abs(suspension.height()));
    }
    const double damper = std::pow(2.0 * ratio * r, 2);
    const double expected = std::sqrt((1.0 + damper) / (std::pow(1.0 - r * r, 2) + damper));
    EXPECT_NEAR(largest / amplitude, expected, 3e-3 * expected) << r;
  }
}

}  // namespace
}  // namespace furrow::suspension_test

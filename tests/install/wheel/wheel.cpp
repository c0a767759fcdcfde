// SPDX-License-Identifier: GPL-2.0-or-later
// A wheel of the installed library falls freely for one second: z - z0 = -g t^2/2.

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "furrow/bodies/rigid_wheel.h"
#include "furrow/io/files/version.h"

int main() {
  const std::vector<std::string> words = {"diameter", "0.6", "width",   "0.2",
                                          "mass",     "10",  "inertia", "0.4"};
  furrow::RigidWheel wheel(furrow::RigidWheel::schema().read(words));
  wheel.release(furrow::Coordinate::z);
  const double gravity = 9.81, dt = 1e-3;
  const int steps = 1000;
  wheel.set_load({0.0, 0.0, -10.0 * gravity});
  for (int i = 0; i < steps; ++i) wheel.advance(dt);
  // velocities at half steps, from rest: the sum of (i + 1) g dt^2
  const double fallen = -gravity * dt * dt * steps * (steps + 1) / 2.0,
               z = wheel.position(furrow::Coordinate::z);
  std::printf("furrow %s: z = %.6f m, expected %.6f m, triangles %zu\n", furrow::version().c_str(),
              z, fallen, wheel.surface().triangle_count());
  return std::abs(z - fallen) < 1e-9 && wheel.surface().is_closed() ? 0 : 1;
}

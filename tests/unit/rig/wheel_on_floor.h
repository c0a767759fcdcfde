// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A small wheel and a floor with friction, for tests of the rig whose result is known in closed
/// form.

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "furrow/bodies/rigid_wheel.h"
#include "furrow/rig/wheel_rig.h"
#include "tests/support/words.h"

namespace furrow {

/// Segments: a rolling polygon rises and falls, by 0.15 mm with 80 and by 0.04 mm with 160.
inline RigidWheel make_wheel(double height = 0.2, int segments = 80) {
  RigidWheelParameters wheel;
  wheel.geometry.diameter = 0.4;
  wheel.geometry.width = 0.1;
  wheel.geometry.segments = segments;
  wheel.geometry.element_size = segments > 80 ? 0.05 : 0.1;
  wheel.hub = {{3.0, 0.06, 0.04}, {0.0, 0.0, height}};
  return RigidWheel(wheel);
}

/// The rig of a line of keywords; others: keywords that the line may leave out.
inline WheelRig rig_of(RigidWheel& wheel, const std::string& line, const std::string& others = "") {
  return WheelRig(WheelRig::schema("fix wheel/rig").read(test::words(line, others)), wheel);
}

/// A rigid floor at z = 0 by a penalty, with Coulomb friction that is viscous at creeping speeds.
struct Floor {
  double stiffness = 3e5;  // [N/m] a node
  double friction = 0.5;   // [-]
  double creep = 1e-3;     // [m/s] below it friction is proportional to the sliding speed

  void press_on(Surface& surface) const {
    surface.clear_forces();
    for (Eigen::Index node = 0; node < surface.x.cols(); ++node) {
      const double normal = -stiffness * surface.x(2, node);
      if (normal <= 0.0) continue;
      const Vector2 sliding = surface.v.col(node).head<2>();
      const double speed = sliding.norm();
      surface.f(2, node) = normal;
      surface.f.col(node).head<2>() = -friction * normal * sliding / std::max(speed, creep);
    }
  }
};

/// Runs rig and wheel to an end on a floor (or without); calls each row.
inline void run(WheelRig& rig, RigidWheel& wheel, double end, double dt, const Floor* floor,
                const std::function<void(const std::vector<double>&)>& each) {
  const long steps = std::lround(end / dt);
  for (long i = 0; i < steps; ++i) {
    rig.apply(i * dt, dt);
    wheel.advance(dt);
    if (floor) floor->press_on(wheel.surface());
    each(rig.measure((i + 1) * dt));
  }
}

}  // namespace furrow

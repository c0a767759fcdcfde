// SPDX-License-Identifier: GPL-2.0-or-later
#include "tyre/rim_damping.h"

namespace furrow {

void RimDamping::add(ShellNodes& nodes, const WheelHub& rim) {
  force_.resize(3, nodes.count());
  moment_.resize(3, nodes.count());
  for (Eigen::Index n = 0; n < nodes.count(); ++n) {
    const Vector3 v = nodes.v.col(n);
    const Vector3 w = nodes.w.col(n);
    force_.col(n) = -rate_ * nodes.mass[n] * (v - rim.velocity_at(nodes.x.col(n)));
    moment_.col(n) = -rate_ * nodes.inertia[n] * (w - rim.angular_velocity());
  }
  nodes.force += force_;
  nodes.moment += moment_;
}

Wrench RimDamping::reaction(const ShellNodes& nodes, const Vector3& centre) const {
  Wrench on_rim;
  for (Eigen::Index n = 0; n < nodes.count(); ++n) {
    const Vector3 f = force_.col(n);
    const Vector3 m = moment_.col(n);
    on_rim.force -= f;
    on_rim.moment -= m + Vector3(nodes.x.col(n) - centre).cross(f);
  }
  return on_rim;
}

double RimDamping::power(const ShellNodes& nodes, const Matrix3X& v_before,
                         const Matrix3X& w_before) const {
  double power = 0.0;
  for (Eigen::Index n = 0; n < nodes.count(); ++n) {
    const Vector3 f = force_.col(n);
    const Vector3 m = moment_.col(n);
    power += f.dot(0.5 * (v_before.col(n) + nodes.v.col(n))) +
             m.dot(0.5 * (w_before.col(n) + nodes.w.col(n)));
  }
  return power;
}

}  // namespace furrow

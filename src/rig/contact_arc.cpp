// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/rig/contact_arc.h"

#include <cmath>

namespace furrow {

ContactArc::ContactArc(const WheelHub& hub, std::size_t sectors)
    : hub_(hub), sectors_(sectors), sums_(3 * sectors, 0.0) {}

void ContactArc::add(const Vector3& point, const Vector3& force, const Vector3& sliding,
                     double dt) {
  const Vector3 axle = hub_.axle();
  const Vector3 forward = axle.cross(Vector3::UnitZ()).normalized(), up = forward.cross(axle);
  Vector3 radial = point - hub_.centre();
  radial -= radial.dot(axle) * axle;
  const double angle = std::atan2(radial.dot(forward), -radial.dot(up));
  const double place = (angle / pi + 0.5) * static_cast<double>(sectors_);
  if (!(place >= 0.0 && place < static_cast<double>(sectors_))) return;
  radial.normalize();
  const Vector3 along = radial.cross(axle);
  const double normal = -force.dot(radial);
  double* const sum = &sums_[3 * static_cast<std::size_t>(place)];
  sum[0] += normal * dt;
  sum[1] += force.dot(along) * dt;
  sum[2] -= normal * sliding.dot(along) * dt;
}

ContactArc::Profile ContactArc::profile(const std::vector<double>& sums, double duration) const {
  const double opening = pi / static_cast<double>(sectors_);  // [rad] of a sector
  const double area = opening * hub_.nominal_radius() * hub_.nominal_width();
  const double impulse = area * duration;  // [N s] of 1 Pa
  Profile found;
  for (std::size_t s = 0; s < sectors_; ++s) {
    found.angle.push_back((static_cast<double>(s) + 0.5) * opening - 0.5 * pi);
    found.normal.push_back(sums[3 * s] / impulse);
    found.shear.push_back(sums[3 * s + 1] / impulse);
    found.slip.push_back(sums[3 * s] > 0.0 ? sums[3 * s + 2] / sums[3 * s] : 0.0);
  }
  return found;
}

}  // namespace furrow

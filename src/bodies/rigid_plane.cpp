// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/bodies/rigid_plane.h"

#include <cmath>

#include <fmt/format.h>

#include "furrow/core/options/check_number.h"

namespace furrow {

RigidPlane::RigidPlane(const RigidPlaneParameters& parameters, const Surface& surface)
    : parameters_(parameters) {
  const auto check = [](double value, const Range& range, const char* name, const char* unit) {
    check_number(value, range, fmt::format("rigid plane, {}", name), unit);
  };
  check(parameters.height, Range::any(), "height", "m");
  check(parameters.stiffness, Range::positive(), "stiffness", "Pa/m");
  check(parameters.damping, Range::non_negative(), "damping", "Pa s/m");
  check(parameters.friction, Range::non_negative(), "friction", "");
  check(parameters.tangential_stiffness, Range::positive(), "tangential_stiffness", "Pa/m");
  const auto nodes = static_cast<Eigen::Index>(surface.node_count());
  area_ = surface.node_areas();
  pressure_ = VectorX::Zero(nodes);
  anchor_ = Eigen::Matrix2Xd::Zero(2, nodes);
  sticking_.assign(static_cast<std::size_t>(nodes), 0);
}

void RigidPlane::press_on(Surface& surface) {
  total_.setZero();
  for (Eigen::Index n = 0; n < surface.x.cols(); ++n) {
    const double depth = parameters_.height - surface.x(2, n);
    unsigned char& sticking = sticking_[static_cast<std::size_t>(n)];
    pressure_[n] =
        depth > 0.0
            ? std::max(0.0, parameters_.stiffness * depth - parameters_.damping * surface.v(2, n))
            : 0.0;
    if (depth <= 0.0) {
      sticking = 0;
      continue;
    }
    const Vector2 point = surface.x.col(n).head<2>();
    if (!sticking) anchor_.col(n) = point;
    sticking = 1;
    const double k = parameters_.tangential_stiffness;
    const double limit = parameters_.friction * pressure_[n];
    Vector2 shear = k * (anchor_.col(n) - point);
    if (const double size = shear.norm(); size > limit) {
      shear *= limit / size;
      const Vector2 dragged_to = point + shear / k;
      friction_loss_ += area_[n] * limit * (dragged_to - anchor_.col(n)).norm();
      anchor_.col(n) = dragged_to;
    }
    const Vector3 force(area_[n] * shear.x(), area_[n] * shear.y(), area_[n] * pressure_[n]);
    surface.f.col(n) += force;
    total_ += force;
  }
}

void RigidPlane::checkpoint(Checkpoint& state) {
  state.values("anchor", anchor_);
  std::vector<double> sticking(sticking_.begin(), sticking_.end());
  state.values("sticking", sticking.data(), sticking.size());
  std::transform(sticking.begin(), sticking.end(), sticking_.begin(),
                 [](double number) { return static_cast<unsigned char>(number != 0.0); });
  state.values("area", area_);
  state.value("friction_loss", friction_loss_);
  state.values("pressure", pressure_);
  state.values("force", total_);
}

}  // namespace furrow

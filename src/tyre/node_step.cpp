// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/node_step.h"

#include "furrow/simd/dispatch.h"
#include "furrow/tyre/node_step_block.h"

namespace furrow {

namespace {

void copy(const Vector3& from, double (&to)[3]) { Vector3::Map(to) = from; }

Wrench wrench(const double (&force)[3], const double (&moment)[3]) {
  return {Eigen::Map<const Vector3>(force), Eigen::Map<const Vector3>(moment)};
}

}  // namespace

void NodeStep::take_supports(const ShellNodes& nodes) {
  const auto count = static_cast<std::size_t>(nodes.count());
  const std::size_t padded =
      (count + node_step_padding - 1) / node_step_padding * node_step_padding;
  mass_.assign(padded, 0.0);
  inertia_.assign(padded, 0.0);
  for (auto* arrays : {&mobility_, &spin_mobility_})
    for (std::vector<double>& array : *arrays) array.assign(padded, 0.0);
  for (std::size_t n = 0; n < count; ++n) {
    const auto node = static_cast<Eigen::Index>(n);
    mass_[n] = nodes.mass[node];
    inertia_[n] = nodes.inertia[node];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      mobility_[k][n] = nodes.free_to_move(axis, node) / nodes.mass[node];
      spin_mobility_[k][n] = nodes.free_to_turn(axis, node) / nodes.inertia[node];
    }
  }
}

NodeStep::Sums NodeStep::move(ShellNodes& nodes, const Matrix3X& contact, const WheelHub& rim,
                              double dt) const {
  NodeStepNodes view;
  view.count = nodes.q.size();
  view.x = nodes.x.data();
  view.v = nodes.v.data();
  view.w = nodes.w.data();
  view.turn = nodes.q[0].coeffs().data();
  view.force = nodes.force.data();
  view.moment = nodes.moment.data();
  view.contact = contact.data();
  view.mass = mass_.data();
  view.inertia = inertia_.data();
  for (std::size_t k = 0; k < 3; ++k) {
    view.mobility[k] = mobility_[k].data();
    view.spin_mobility[k] = spin_mobility_[k].data();
  }
  NodeStepRim frame;
  copy(rim.centre(), frame.centre);
  copy(rim.velocity(), frame.velocity);
  copy(rim.angular_velocity(), frame.spin);
  const NodeStepSums sums = kernels<NodeStepKernels>().step(view, frame, rate_, dt);
  return {wrench(sums.force, sums.moment), wrench(sums.damping_force, sums.damping_moment),
          sums.contact_power, sums.damping_power, sums.finite};
}

}  // namespace furrow

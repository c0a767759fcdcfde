// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/shell/shell_nodes.h"

#include <algorithm>
#include <cmath>

#include "furrow/core/half_turn.h"

namespace furrow {

ShellNodes::ShellNodes(const Matrix3X& start)
    : x(start),
      q(static_cast<std::size_t>(start.cols()), Quaternion::Identity()),
      mass(VectorX::Zero(start.cols())),
      inertia(VectorX::Zero(start.cols())) {
  for (Matrix3X* m : {&v, &w, &force, &moment}) m->setZero(3, start.cols());
  for (Matrix3X* m : {&free_to_move, &free_to_turn}) m->setOnes(3, start.cols());
}

void ShellNodes::hold(Eigen::Index node) {
  free_to_move.col(node).setZero();
  free_to_turn.col(node).setZero();
}

void ShellNodes::kick(double dt) {
  for (Eigen::Index n = 0; n < count(); ++n) {
    v.col(n) += (dt / mass[n]) * force.col(n).cwiseProduct(free_to_move.col(n));
    w.col(n) += (dt / inertia[n]) * moment.col(n).cwiseProduct(free_to_turn.col(n));
  }
}

void ShellNodes::drift(double dt) {
  x += dt * v;
  for (Eigen::Index n = 0; n < count(); ++n) {
    const Vector3 half = 0.5 * dt * w.col(n);
    const double squared = half.squaredNorm();
    if (squared == 0.0) continue;
    HalfTurn<double> turn = half_turn(squared);
    if (squared > small_half_turn) {
      const double angle = std::sqrt(squared);
      turn = {std::cos(angle), std::sin(angle) / angle};
    }
    const auto [cosine, sinc] = turn;
    Quaternion turned = Quaternion(cosine, sinc * half.x(), sinc * half.y(), sinc * half.z()) *
                        q[static_cast<std::size_t>(n)];
    turned.normalize();
    set_rotation(n, turned);
  }
}

void ShellNodes::stop() {
  v.setZero();
  w.setZero();
}

double ShellNodes::kinetic_energy() const {
  double twice = 0.0;
  for (Eigen::Index n = 0; n < count(); ++n)
    twice += mass[n] * v.col(n).squaredNorm() + inertia[n] * w.col(n).squaredNorm();
  return 0.5 * twice;
}

double ShellNodes::largest_unbalanced(double length) const {
  return std::max(force.cwiseProduct(free_to_move).cwiseAbs().maxCoeff(),
                  moment.cwiseProduct(free_to_turn).cwiseAbs().maxCoeff() / length);
}

void ShellNodes::checkpoint(Checkpoint& state) {
  state.values("position", x);
  state.values("velocity", v);
  state.values("angular_velocity", w);
  for (Eigen::Index n = 0; n < count(); ++n) {
    Quaternion turn = q[static_cast<std::size_t>(n)];
    state.values("rotation", turn.coeffs().data(), 4);
    if (!state.saving()) set_rotation(n, turn);
  }
}

}  // namespace furrow

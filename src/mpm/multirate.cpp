// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/multirate.h"

#include <algorithm>
#include <cmath>

namespace furrow {

namespace {

constexpr double rounding = 1e-9;  // of an interval: sum of its steps against their number times dt

}  // namespace

/// The last step of an interval is the one after which another of the same length would exceed T.
bool Multirate::add(Surface& mesh, double dt) {
  impulse_ += dt * mesh.f;
  elapsed_ += dt;
  if (elapsed_ + dt > (1.0 + rounding) * interval_) return true;
  offset_ += dt;
  place(mesh);
  return false;
}

void Multirate::begin(Surface& mesh, double dt, double stable) {
  stable_ = stable;
  interval_ = dt * std::max(1.0, std::floor(stable / dt));
  elapsed_ = 0.0;
  impulse_.setZero(3, mesh.x.cols());
  x_ = mesh.x;
  offset_ = -0.5 * (interval_ - dt);
  place(mesh);
}

void Multirate::resume(Surface& mesh) {
  if (!begun()) return;
  x_ = mesh.x;
  place(mesh);
}

void Multirate::checkpoint(Checkpoint& state, Eigen::Index nodes) {
  if (!begun()) impulse_.setZero(3, nodes);
  state.values("surface_impulse", impulse_);
  state.value("interval", interval_);
  state.value("elapsed", elapsed_);
  state.value("offset", offset_);
  state.value("interval_stable_step", stable_);
}

}  // namespace furrow

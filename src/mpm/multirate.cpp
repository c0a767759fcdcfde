// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/multirate.h"

#include <algorithm>
#include <cmath>

namespace furrow {

namespace {

constexpr double rounding = 1e-9;  // of an interval: sum of its steps against their number times dt

}  // namespace

/// The last step of an interval is the one after which another of the same length would exceed T.
bool Multirate::add(Surface& sheet, double dt) {
  impulse_ += dt * sheet.f;
  elapsed_ += dt;
  if (elapsed_ + dt > (1.0 + rounding) * interval_) return true;
  offset_ += dt;
  place(sheet);
  return false;
}

void Multirate::begin(Surface& sheet, double dt, double stable) {
  stable_ = stable;
  interval_ = dt * std::max(1.0, std::floor(stable / dt));
  elapsed_ = 0.0;
  impulse_.setZero(3, sheet.x.cols());
  x_ = sheet.x;
  offset_ = -0.5 * (interval_ - dt);
  place(sheet);
}

void Multirate::resume(Surface& sheet) {
  if (!begun()) return;
  x_ = sheet.x;
  place(sheet);
}

void Multirate::checkpoint(Checkpoint& state, Eigen::Index nodes) {
  if (!begun()) impulse_.setZero(3, nodes);
  state.values("sheet_impulse", impulse_);
  state.value("interval", interval_);
  state.value("elapsed", elapsed_);
  state.value("offset", offset_);
  state.value("interval_stable_step", stable_);
}

}  // namespace furrow

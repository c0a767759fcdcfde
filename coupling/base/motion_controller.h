// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What sets loads and prescribed motions before every step: a rig, a plate's drive, terrain that
/// moves along.

namespace furrow::coupling {

class MotionController {
 public:
  virtual ~MotionController() = default;
  /// For the step [time, time + dt] [s]. @throws StateError
  virtual void apply(double time, double dt) = 0;
};

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Sets loads and prescribed motions before every step: a rig, the drive of a plate, or terrain
/// that follows a body.

namespace furrow::coupling {

class MotionController {
 public:
  virtual ~MotionController() = default;
  /// Sets motions and loads for the step [time, time + dt] [s]. @throws StateError
  virtual void apply(double time, double dt) = 0;
};

}  // namespace furrow::coupling

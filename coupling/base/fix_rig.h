// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Base of fixes that drive a wheel, as wheel/history sees them.

#include "coupling/base/fix_wheel_hub.h"
#include "rig/wheel_rig.h"

namespace furrow::coupling {

class FixRig : public FurrowFix {
 public:
  virtual const WheelRig& rig() const = 0;
  virtual FixWheelHub& wheel_fix() const = 0;

 protected:
  using FurrowFix::FurrowFix;
};

}  // namespace furrow::coupling

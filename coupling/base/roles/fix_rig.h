// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Base of fixes that drive a wheel, as wheel/history sees them.

#include <optional>

#include "coupling/base/fix_wheel_hub.h"
#include "furrow/rig/wheel_rig.h"

namespace furrow::coupling {

class FixRig : public FurrowFix {
 public:
  virtual const WheelRig& rig() const = 0;
  virtual FixWheelHub& wheel_fix() const = 0;
  /// Time at which a program last changed targets between two steps [s].
  virtual std::optional<double> last_change() const { return {}; }

 protected:
  using FurrowFix::FurrowFix;
};

}  // namespace furrow::coupling

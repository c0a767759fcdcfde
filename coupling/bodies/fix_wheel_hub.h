// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What fixes that make a wheel or a tyre have in common: a hub that a wheel/rig drives and a
/// wheel/history records.

#include "bodies/wheel_hub.h"
#include "coupling/output/effective_input.h"
#include "coupling/bodies/fix_body.h"

namespace furrow::coupling {

class FixWheelHub : public FixBody, public HasOptions {
 public:
  /// @param options as they took effect
  FixWheelHub(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, std::unique_ptr<WheelHub> hub,
              const Options& options)
      : FixBody(lammps, narg, arg, std::move(hub)), options_(options) {}

  WheelHub& hub() { return static_cast<WheelHub&>(body()); }
  const Options& options() const override { return options_; }

 private:
  Options options_;
};

}  // namespace furrow::coupling

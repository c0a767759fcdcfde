// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The base of every fix that makes a wheel or a tyre: a hub that a wheel/rig drives and a
/// wheel/history records. Its keys are those of bodies/hub_parameters.h beside its own.

#include "furrow/bodies/wheel_hub.h"
#include "coupling/base/fix_body.h"

namespace furrow::coupling {

class FixWheelHub : public FixBody {
 public:
  WheelHub& hub() { return static_cast<WheelHub&>(body()); }

 protected:
  using MakeHub = std::function<std::unique_ptr<WheelHub>(const Options&)>;
  FixWheelHub(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Schema& schema,
              const MakeHub& make_hub)
      : FixBody(lammps, narg, arg, schema, make_hub) {}
};

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix wheel/rig: drives a wheel. See fix_wheel_rig.md.

#include <map>
#include <optional>
#include <string>

#include "coupling/base/roles/fix_rig.h"
#include "coupling/base/roles/motion_controller.h"

namespace furrow::coupling {

class FixWheelRig : public FixRig, public MotionController {
 public:
  FixWheelRig(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();

  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void apply(double time, double dt) override;
  /// Tilts the gravity of grains on a slope.
  void post_force(int) override;

  /// Sets other targets from the next step on, each a key and its value as a script writes them.
  /// @throws InputError, and nothing has changed
  void change_targets(const std::vector<Entry>& targets);

  /// The table with the checksum of its numbers.
  std::vector<std::pair<std::string, std::string>> settings() const override;
  const WheelRig& rig() const override { return rig_; }
  WheelRig& rig_of_chassis() { return rig_; }
  FixWheelHub& wheel_fix() const override { return wheel_fix_; }
  std::optional<double> last_change() const override { return last_change_; }

 private:
  void checkpoint(Checkpoint& state) override;
  bool state_needs_options() const override { return rig_.has_suspension(); }
  void retarget(const std::map<std::string, std::string>& targets);
  FixWheelHub& find_free_wheel();
  bool on_slope() const { return rig_.on_slope(); }
  void warn_of_short_ramps();
  void warn_of_soft_spring();
  void warn_of_small_torque();
  void check_slope();
  void check_passes();

  FixWheelHub& wheel_fix_;
  const Courses table_;
  WheelRig rig_;
  const Options line_;                          // line of the script
  std::map<std::string, std::string> changed_;  // targets, and their last values
  std::optional<double> last_change_;           // of targets [s]
  bool warned_ = false;                         // of short ramps
  bool warned_of_spring_ = false, warned_of_torque_ = false;
};

}  // namespace furrow::coupling

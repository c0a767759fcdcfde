// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A script of one wheel on its ground, moved step by step by an importer of the FMU.

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "furrow/bodies/wheel_hub.h"
#include "coupling/fmi/variables.h"
#include "coupling/session/session.h"

namespace furrow::coupling::fmi {

/// Inputs that the importer sets, and outputs that it reads.
struct Values {
  std::array<double, real_count> reals{};
  std::array<bool, boolean_count> booleans = boolean_starts;
  /// x, y, z, yaw and camber that the importer has set. The others follow from their rates.
  std::array<bool, 5> pose_given{};
  std::vector<std::string> strings;
};

class OneWheel {
 public:
  /// Place of a wheel, and the files of a checkpoint: none before the first step.
  struct State {
    std::array<double, 5> pose{};
    std::map<std::string, std::string> files;
  };

  /// Runs the script up to its first run. @param state of another wheel of this script to continue;
  /// may be null. @throws RunError, Error
  OneWheel(const std::string& script, const std::vector<Contents::ScriptVariable>& variables,
           const std::string& log, const State* state);

  /// Moves the wheel for a communication step [s] and writes the outputs.
  /// @return the time that was computed [s]: less at the end of the script
  /// @throws InputError for a step or a motion that cannot be, before anything moves; RunError
  double advance(double step, Values& values);
  void read(Values& values) const;
  State state() const;
  /// True if state() is that from which this wheel began, so that steps from there have the same
  /// bits. Neighbour lists of grains differ after a step.
  bool begins_at_state() const;
  /// Warnings of Furrow since the last call.
  std::vector<std::string> take_warnings() { return session_->take_warnings(); }

 private:
  WheelHub& hub() const;
  /// @throws InputError for a load, torque or spin rate that no wheel of this mass has
  static void check_inputs(const WheelHub& wheel, const Values& values);
  std::array<double, 5> rates(double seconds, const Values& values) const;

  std::unique_ptr<Session> session_;
  std::string id_;              // of the wheel
  std::array<double, 5> pose_;  // x, y, z [m], yaw, camber [rad]
  State before_;                // of the checkpoint from which it continues
  bool moved_ = false;
};

}  // namespace furrow::coupling::fmi

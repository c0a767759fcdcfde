// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// An instance of the FMU: the phases of FMI 2.0's co-simulation, and what each allows.

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "coupling/fmi/fmi2.h"
#include "coupling/fmi/one_wheel.h"
#include "coupling/fmi/variables.h"

namespace furrow::coupling::fmi {

class WheelFmu {
 public:
  enum class Phase { instantiated, initializing, stepping, discarded, terminated, failed };

  /// State that fmi2GetFMUstate keeps.
  struct Snapshot {
    Phase phase;
    Values values;
    double time;
    std::optional<OneWheel::State> wheel;
  };

  /// @throws Error for another guid than that of the resources
  WheelFmu(std::string name, const std::string& guid, const std::string& resources,
           const fmi2CallbackFunctions& callbacks);

  void set_up(double start);
  void enter_initialization();
  void exit_initialization();
  fmi2Status step(double time, double length);
  void terminate();
  void reset();

  double real(fmi2ValueReference reference);
  bool boolean(fmi2ValueReference reference) const;
  const std::string& string(fmi2ValueReference reference) const;
  void set_real(fmi2ValueReference reference, double value);
  void set_boolean(fmi2ValueReference reference, bool value);
  void set_string(fmi2ValueReference reference, const char* value);

  std::unique_ptr<Snapshot> snapshot();
  void restore(const Snapshot& snapshot);

  double time() const { return time_; }  ///< of the last step that was complete [s]
  bool ended() const { return phase_ == Phase::discarded; }
  void fail() { phase_ = Phase::failed; }
  void log(fmi2Status status, const std::string& message) const;

 private:
  void need(std::initializer_list<Phase> allowed) const;
  void open(const OneWheel::State* state);
  void need_closed(const std::string& parameter) const;
  Values start_values() const;
  void log_once(const std::string& warning);
  void log_warnings();
  void warn_of_unused_inputs();

  std::string name_, resources_;
  fmi2CallbackFunctions callbacks_;
  Contents contents_;
  Phase phase_ = Phase::instantiated;
  Values values_;
  double time_ = 0.0;
  std::unique_ptr<OneWheel> wheel_;
  std::set<std::string> warned_;
};

/// Converts a snapshot to bytes, and back. @throws Error for other bytes
std::vector<std::uint8_t> pack(const WheelFmu::Snapshot& snapshot);
std::unique_ptr<WheelFmu::Snapshot> unpack(const fmi2Byte* bytes, std::size_t size);

}  // namespace furrow::coupling::fmi

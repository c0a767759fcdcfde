// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The variables of the FMU, which its modelDescription.xml lists.

#include <array>
#include <string>
#include <vector>

namespace furrow::coupling::fmi {

/// Value references of the Real variables: inputs, then outputs.
enum Real : unsigned {
  position_x,
  position_y,
  position_z,
  yaw,
  camber,
  velocity_x,
  velocity_y,
  velocity_z,
  yaw_rate,
  camber_rate,
  load,
  spin_torque,
  spin_rate,
  force_x,
  force_y,
  force_z,
  moment_x,
  moment_y,
  moment_z,
  hub_z,
  hub_velocity_z,
  hub_spin,
  hub_spin_rate,
  real_count
};
constexpr unsigned first_output = force_x;

/// Value references of the Boolean parameters.
enum Boolean : unsigned { spin_by_torque, height_by_load, boolean_count };

/// Value references of the String parameters; those of the script's variables follow.
enum String : unsigned { script, log, first_script_variable };

/// FMI 3.0 counts all types together; Real variables begin at 0 there as well.
constexpr unsigned first_boolean_of_3 = 1000, first_string_of_3 = 2000;

struct Variable {
  const char* name;
  const char* unit;
  const char* meaning;
};
extern const std::array<Variable, real_count> reals;
extern const std::array<Variable, boolean_count> booleans;
extern const std::array<Variable, first_script_variable> strings;
constexpr std::array<bool, boolean_count> boolean_starts{true, false};

/// Data that an FMU keeps in its resources next to the script.
struct Contents {
  struct ScriptVariable {
    std::string name, value;
  };
  std::string guid, script;
  std::vector<ScriptVariable> variables;
  bool keeps_states = false;  ///< the script has the variable 'begin' or 'from', for checkpoints
};
/// @throws Error that names the file
Contents read_contents(const std::string& file);

/// modelDescription.xml of FMI 2.0 or 3.0. @param name of the model
std::string describe(const Contents& contents, const std::string& name, int version);

}  // namespace furrow::coupling::fmi

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// bed: a settled bed of grains, made once and kept. See command_bed.md.

#include <map>
#include <string>
#include <vector>

#include "pointers.h"

namespace furrow::coupling {

class CommandBed : protected LAMMPS_NS::Pointers {
 public:
  explicit CommandBed(LAMMPS_NS::LAMMPS* lammps) : Pointers(lammps) {}
  void command(int narg, char** arg);

 private:
  using Parameters = std::vector<std::pair<std::string, std::string>>;

  void set_variable(const std::string& name, const std::string& value);
  void run_script(const std::string& text);
  /// Packing of the bed that stands in the box now; collective.
  std::map<std::string, double> measure(double depth);
};

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/bed_line.h"

#include <sstream>

#include "coupling/liggghts/styles/script.h"

namespace furrow::coupling {

namespace {

constexpr char line_variable[] = "furrow_bed";  // keyword and value alternate, one on each line
constexpr char values_variable[] = "furrow_bed_parameters";

}  // namespace

void set_bed_line(LAMMPS_NS::LAMMPS& lammps, const BedLine& line, const std::string& values) {
  std::string text;
  for (const auto& [name, value] : line) text += (text.empty() ? "" : "\n") + name + "\n" + value;
  set_variable(lammps, line_variable, text);
  set_variable(lammps, values_variable, values);
}

BedLine bed_line(LAMMPS_NS::LAMMPS& lammps) {
  BedLine line;
  std::istringstream text(variable(lammps, line_variable).value_or(""));
  std::string name, value;
  while (std::getline(text, name) && std::getline(text, value)) line.emplace_back(name, value);
  return line;
}

std::string bed_values(LAMMPS_NS::LAMMPS& lammps) {
  return variable(lammps, values_variable).value_or("none");
}

}  // namespace furrow::coupling

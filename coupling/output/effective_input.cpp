// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/output/effective_input.h"

#include <fstream>
#include <sstream>

#include "coupling/liggghts/access.h"
#include "group.h"
#include "modify.h"

namespace furrow::coupling {

std::string effective_input(LAMMPS_NS::LAMMPS& lammps) {
  std::ostringstream text;
  text << "# styles with their effective values\n";
  for (int i = 0; i < lammps.modify->nfix; ++i) {
    const LAMMPS_NS::Fix& fix = *lammps.modify->fix[i];
    const auto* described = dynamic_cast<const HasOptions*>(&fix);
    if (!described) continue;
    text << "fix " << fix.id << ' ' << lammps.group->names[fix.igroup] << ' ' << fix.style;
    for (const Entry& entry : described->options().effective()) {
      text << ' ' << entry.key;
      for (const std::string& value : entry.values) text << ' ' << value;
    }
    text << '\n';
  }
  const std::string script = script_name(lammps);
  if (std::ifstream file{script}) text << "\n# script " << script << '\n' << file.rdbuf();
  return text.str();
}

}  // namespace furrow::coupling

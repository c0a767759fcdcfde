// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/output/style_records.h"

#include <fstream>
#include <sstream>

#include "coupling/base/bed_line.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/liggghts/styles/configured_style.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "group.h"

namespace furrow::coupling {

std::vector<StyleRecord> style_records(LAMMPS_NS::LAMMPS& lammps) {
  std::vector<StyleRecord> records;
  const BedLine bed = bed_line(lammps);
  if (!bed.empty()) {
    StyleRecord record{"", "", "bed", find_style("bed")->kind, {}};
    for (const auto& [name, value] : bed) record.options.push_back({name, {typed_value(value)}});
    records.push_back(std::move(record));
  }
  for (const auto* configured : fixes_of<const ConfiguredStyle>(*lammps.modify)) {
    const LAMMPS_NS::Fix& fix = as_fix(*configured);
    if (const Style* style = find_style(style_of(fix)))
      records.push_back({fix.id, lammps.group->names[fix.igroup], style->name, style->kind,
                         typed_values(configured->options())});
  }
  return records;
}

std::string effective_input(LAMMPS_NS::LAMMPS& lammps) {
  std::ostringstream text;
  text << "# styles with their effective values\n";
  const BedLine bed = bed_line(lammps);
  for (const auto& [name, value] : bed)
    text << (name == "script" ? "bed" : ' ' + name) << ' ' << value;
  if (!bed.empty()) text << '\n';
  for (const auto* configured : fixes_of<const ConfiguredStyle>(*lammps.modify)) {
    const LAMMPS_NS::Fix& fix = as_fix(*configured);
    text << "fix " << fix.id << ' ' << lammps.group->names[fix.igroup] << ' ' << style_of(fix);
    for (const Entry& entry : configured->options().effective()) {
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

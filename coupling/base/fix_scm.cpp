// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/fix_scm.h"

#include <filesystem>

#include "coupling/liggghts/script.h"
#include "io/heightmap_file.h"

namespace furrow::coupling {

namespace {

std::optional<SoilCard> card_of(const Options& options, const std::string& folder) {
  if (!options.given("card")) return {};
  return read_soil_card((std::filesystem::path(folder) / options.text("card")).string());
}

HeightFieldParameters field_of(const Options& options, const std::string& folder) {
  HeightFieldParameters field = height_field_from(options);
  field.relief = read_relief(options, folder);
  return field;
}

}  // namespace

const Outputs<FixScm>& FixScm::outputs() {
  static const Outputs<FixScm> list = {
      {"deepest", "m", "largest permanent sinkage",
       [](FixScm& fix) { return fix.field().deepest(); }},
      {"volume_below", "m^3", "volume of ruts below the undisturbed level",
       [](FixScm& fix) { return fix.field().volume_below(); }},
      {"volume_above", "m^3", "volume of soil above the undisturbed level",
       [](FixScm& fix) { return fix.field().volume_above(); }},
  };
  return list;
}

FixScm::FixScm(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Schema& schema)
    : FurrowFix(lammps, narg, arg, schema),
      card_(card_of(options(), script_folder(*lammps))),
      soil_(soil_from(options(), card_ ? card_->values : std::map<std::string, double>())),
      field_(field_of(options(), script_folder(*lammps)), options().subject()) {
  keep_state();
  provide(outputs());
}

}  // namespace furrow::coupling

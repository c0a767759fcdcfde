// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/roles/fix_scm.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "coupling/liggghts/styles/script.h"
#include "furrow/core/options/check_number.h"
#include "furrow/io/formats/heightmap_file.h"
#include "furrow/io/inputs/patch_input.h"

namespace furrow::coupling {

namespace {

std::optional<SoilCard> card_of(const Options& options, const std::string& folder) {
  if (!options.given("card")) return {};
  return read_soil_card((std::filesystem::path(folder) / options.text("card")).string());
}

/// Soils of the line and of the cards of its patches. All have the stiffness, damping and flow of
/// the line. None for a line that has no parameter of a soil.
std::optional<SoilPatches> soils_of(const Options& options, const std::optional<SoilCard>& card,
                                    const HeightFieldParameters& field, const std::string& folder) {
  using Values = std::map<std::string, double>;
  const auto of_soil = {"k_c", "k_phi", "n", "c", "phi", "K", "card", "patches"};
  if (std::none_of(of_soil.begin(), of_soil.end(),
                   [&](const char* key) { return options.given(key); }))
    return std::nullopt;
  SoilPatches soils(soil_from(options, card ? card->values : Values()));
  const PatchesInput patches = read_patches(options);
  const double middle = field.centre[patches.axis],
               half = 0.5 * (patches.axis == 0 ? field.length : field.width);
  for (const PatchInput& patch : patches.list) {
    need(std::abs(patch.begin - middle) < half, options.where("patches"),
         fmt::format("begins a patch at {:g} m", patch.begin),
         fmt::format("a place on the ground, {:g} to {:g} m", middle - half, middle + half));
    const SoilCard of_patch = read_soil_card((std::filesystem::path(folder) / patch.soil).string());
    soils.add(patches.axis, patch.begin, soil_of_card(options, of_patch.values));
  }
  return soils;
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
      soils_(soils_of(options(), card_, height_field_from(options()), script_folder(*lammps))),
      field_(field_of(options(), script_folder(*lammps)), options().subject()) {
  if (const std::string note = field_.parameters().relief.note(); !note.empty())
    warn(*lmp, fmt::format("{}: {}", options().where("heightmap"), note));
  keep_state();
  provide(outputs());
}

std::pair<double, double> FixScm::extent(int direction) const {
  if (direction == 2) return {-std::numeric_limits<double>::infinity(), level()};
  return {field_.lower()[direction], field_.upper()[direction]};
}

std::vector<GivenGravity> FixScm::gravities() const {
  if (!card_ && !options().given("gravity")) return {};
  return {{options().where("gravity"), {0.0, 0.0, -options().number("gravity")}}};
}

/// Two heights of each cell.
double FixScm::checkpoint_size() const {
  return 2.0 * sizeof(double) * static_cast<double>(field_.cells());
}

Vector3 FixScm::cells_across(const Vector3& lower, const Vector3& upper) const {
  Vector3 cells = (upper - lower) / field_.cell();
  cells.z() = std::numeric_limits<double>::quiet_NaN();
  return cells;
}

Terrain::KnownContact FixScm::known_contact() const {
  if (!card_) return {id, {}};
  return {options().text("card"), card_->contact};
}

/// Nodes keep their places in memory.
const Surface& FixScm::surface() {
  Surface now = field_.triangles();
  if (surface_.triangle_count() == 0)
    surface_ = std::move(now);
  else
    surface_.x = now.x;
  return surface_;
}

}  // namespace furrow::coupling

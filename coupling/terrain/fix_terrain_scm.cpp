// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/terrain/fix_terrain_scm.h"

#include <cmath>

#include <fmt/format.h>

#include "comm.h"
#include "furrow/core/error.h"
#include "furrow/core/gravity.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/base/checks/require_unique.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "furrow/io/inputs/patch_input.h"
#include "modify.h"

namespace furrow::coupling {

namespace {

// Under a given sinkage sand without cohesion carries in proportion to gravity, so that k_phi
// changes by at most this share: less than the standard error of any card of inputs/soils
constexpr double largest_change = 0.02;

/// @throws InputError for a card of tests in another gravity
void refuse_other_gravity(const Options& options, const SoilCard& card) {
  const double gravity = options.number("gravity");
  if (!card.gravity || std::abs(gravity / *card.gravity - 1.0) <= largest_change) return;
  throw InputError(
      options.where("gravity"),
      fmt::format("is {:.4g} m/s^2, and the soil card holds at {:.4g} m/s^2", gravity,
                  *card.gravity),
      fmt::format("a difference of at most {:g} %, because k_phi of sand grows with gravity",
                  100.0 * largest_change),
      fmt::format("make a card with 'furrow-post card make GROUND --gravity {:.6g}', or write "
                  "'gravity {:.6g}' if the run takes place there; give k_c to K in the line and no "
                  "card to use them in any gravity",
                  gravity, *card.gravity));
}

}  // namespace

const StyleRow terrain_scm_style =
    fix_style<FixTerrainScm>("terrain/scm", "scm", "terrain/fix_terrain_scm.md");

Schema FixTerrainScm::schema() {
  Schema schema("fix terrain/scm");
  declare_height_field(schema);
  declare_relief(schema);
  schema
      .text("card",
            "soil card (YAML), or terrain file of Chrono's SCM (JSON), that gives the parameters "
            "which the line does not")
      .optional();
  schema
      .number("gravity", "m/s^2", admissible_gravity(),
              "of the place; the card must come from tests in the same gravity")
      .by_default(standard_gravity);
  declare_soil(schema);
  declare_patches(schema, "card");
  return schema;
}

FixTerrainScm::FixTerrainScm(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixScm(lammps, narg, arg, schema()) {
  if (card()) refuse_other_gravity(options(), *card());
  if (card() && !card()->gravity)
    warn(*lmp, fmt::format("{} states no gravity: Furrow takes its values as they are",
                           options().where("card")));
  std::vector<std::string> all =
      field().parameters().relief.warnings(options().number("length"), field().cell(), false);
  if (soils() &&
      options().warnings().empty())  // otherwise the user must first correct a value of the line
    for (const Soil& soil : soils()->all())
      for (const std::string& warning : plausibility_warnings(soil)) all.push_back(warning);
  for (const std::string& warning : all)
    warn(*lmp, fmt::format("{}: {}", options().subject(), warning));
  refuse_overlap();
  if (comm->me == 0 && screen)
    fmt::print(screen, "Height field: {} x {} cells of {:.4g} m, z = {:.4g} m\n", field().columns(),
               field().rows(), field().cell(), field().parameters().level);
}

/// Refuses overlapping fields, which would both carry a body. Two of them side by side share an
/// edge.
void FixTerrainScm::refuse_overlap() {
  require_unique<FixTerrainScm>(*modify, options().subject(), "covers ground with a height field",
                                "height fields that do not overlap; soils side by side are in the "
                                "keyword 'patches' of one field",
                                [&](const auto& other) { return overlap(*this, other); });
}

}  // namespace furrow::coupling

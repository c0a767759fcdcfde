// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/wheels/fix_tyre_brick.h"

#include <fmt/format.h>

#include "atom.h"
#include "furrow/core/communicator.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "furrow/io/inputs/brick_tyre_file.h"

namespace furrow::coupling {

namespace {

/// Reads the tyre file, makes the tyre and inflates it.
std::unique_ptr<WheelHub> make_brick_tyre(LAMMPS_NS::LAMMPS& lammps, const Options& options) {
  BrickTyreParameters parameters = read_brick_tyre_file(tyre_path(lammps, options));
  parameters.pressure = read_pressure(options, parameters.pressure);
  BrickTyreSettings settings;
  settings.sections = static_cast<int>(options.integer("sections"));
  settings.half = options.flag("half");
  settings.damping_rate = options.number("damping");
  const HubParameters hub = read_hub(options, parameters.bead_spacing());
  check_rim(options, hub, parameters.bead_radius());
  auto tyre = std::make_unique<BrickTyre>(parameters, settings, hub, options.subject());
  check_damping(options, tyre->stable_time_step());
  inflate(options, *tyre);
  return tyre;
}

}  // namespace

const StyleRow tyre_brick_style =
    fix_style<FixTyreBrick>("tyre/brick", "wheel", "wheels/fix_tyre_brick.md");

Schema FixTyreBrick::schema() {
  Schema schema("fix tyre/brick");
  declare_file_and_pressure(schema);
  schema
      .integer("sections", Range::closed(12, 1000),
               "elements around the tyre; those across are 0.45 as long or shorter")
      .by_default("120");
  schema.flag(
      "half",
      "`yes`: only the half y >= 0 is computed, mirrored, for straight travel on symmetric ground");
  declare_hub(schema);
  declare_damping(schema);
  return schema;
}

FixTyreBrick::FixTyreBrick(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixTyre(lammps, narg, arg, schema(),
              [lammps](const Options& options) { return make_brick_tyre(*lammps, options); }) {}

void FixTyreBrick::init() {
  FixTyre::init();
  if (const std::string warning = wrinkling(tyre().parameters()); !warning.empty())
    warn(*lmp, fmt::format("{}: {}", name(), warning));
  if (find_user(*modify, "mesh/body", *this)) warn_of_bridging();
}

/// Collective.
void FixTyreBrick::warn_of_bridging() {
  double sums[2] = {0.0, 0.0};  // diameters, count
  for (int i = 0; i < atom->nlocal; ++i) sums[0] += 2.0 * atom->radius[i];
  sums[1] = atom->nlocal;
  Communicator(&world).sum(sums, 2);
  const BrickTyreParameters& parameters = tyre().parameters();
  const double narrowest = parameters.tread.narrowest_void(parameters.radius());
  if (sums[0] > narrowest * sums[1])
    warn(*lmp, fmt::format("{}: the grains' mean diameter of {:.3g} m is more than the {:.3g} m of "
                           "its narrowest groove: they bridge it, and the tread acts as a smooth "
                           "one; use smaller grains, or a smooth tread",
                           name(), sums[0] / sums[1], narrowest));
}

std::string FixTyreBrick::tyre_text() { return brick_tyre_file_text(tyre().parameters()); }

}  // namespace furrow::coupling

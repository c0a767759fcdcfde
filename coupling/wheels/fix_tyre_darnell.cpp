// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/wheels/fix_tyre_darnell.h"

#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "furrow/io/inputs/sidewall_cache.h"
#include "furrow/io/inputs/tyre_file.h"

namespace furrow::coupling {

namespace {

constexpr double largest_mesh = 40000;  // elements, which take an hour to inflate
int whole_number(const Options& options, const char* key, double value) {
  if (value != std::floor(value) || std::abs(value) > 1e6)
    throw InputError(options.where(key), fmt::format("is {}", value), "whole numbers");
  return static_cast<int>(value);
}

/// Reads the tyre file, makes the tyre and inflates it.
std::unique_ptr<WheelHub> make_darnell_tyre(LAMMPS_NS::LAMMPS& lammps, const Options& options) {
  TyreParameters parameters = read_tyre_file(tyre_path(lammps, options));
  parameters.pressure = read_pressure(options, parameters.pressure);

  DarnellTyreSettings settings;
  settings.across = whole_number(options, "mesh", options.numbers("mesh")[0]);
  settings.around = whole_number(options, "mesh", options.numbers("mesh")[1]);
  if (const double elements = options.numbers("mesh")[0] * options.numbers("mesh")[1];
      elements > largest_mesh)
    throw InputError(options.where("mesh"), fmt::format("has {:g} elements", elements),
                     fmt::format("at most {:g}", largest_mesh),
                     "6 72 is usual, 12 144 fine; the step shrinks with the elements");
  settings.half = options.flag("half");
  settings.direct = options.text("sidewall") == "direct";
  settings.sidewall_rows = static_cast<int>(options.integer("sidewall_rows"));
  settings.damping_rate = options.number("damping");

  const HubParameters hub = read_hub(options, parameters.bead_spacing);
  check_rim(options, hub, parameters.bead_radius);
  auto tyre = std::make_unique<DarnellTyre>(parameters, settings, hub, options.subject(),
                                            open_sidewall_table);
  check_damping(options, tyre->stable_time_step());
  inflate(options, *tyre);
  return tyre;
}

}  // namespace

const StyleRow tyre_darnell_style =
    fix_style<FixTyreDarnell>("tyre/darnell", "wheel", "wheels/fix_tyre_darnell.md");

Schema FixTyreDarnell::schema() {
  Schema schema("fix tyre/darnell");
  declare_file_and_pressure(schema);
  schema.numbers("mesh", 2, "", Range::closed(2, 2000), "elements across the tread and around it")
      .by_default(std::vector<double>{6, 72});
  schema.flag(
      "half",
      "`yes`: only the half y >= 0 is computed, mirrored, for straight travel on symmetric ground");
  schema
      .choice("sidewall", {"table", "direct"},
              "`table`: sidewall forces interpolated; `direct`: solved at every station and step")
      .by_default("table");
  schema
      .integer("sidewall_rows", Range::closed(0, 50),
               "rows of contact nodes on each sidewall; 0: only the tread can touch")
      .by_default("4");
  declare_hub(schema);
  declare_damping(schema);
  return schema;
}

FixTyreDarnell::FixTyreDarnell(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixTyre(lammps, narg, arg, schema(),
              [lammps](const Options& options) { return make_darnell_tyre(*lammps, options); }) {}

std::string FixTyreDarnell::tyre_text() { return tyre_file_text(tyre().parameters()); }

}  // namespace furrow::coupling

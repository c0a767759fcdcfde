// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/fix_contact_scm.h"

#include <algorithm>

#include <fmt/format.h>

#include "comm.h"
#include "core/error.h"
#include "coupling/base/fix_scm.h"
#include "coupling/base/require_unique.h"
#include "coupling/liggghts/style_registry.h"
#include "tyre/tyre.h"
#include "update.h"

namespace furrow::coupling {

namespace {

ScmContact::Settings settings_from(const Options& options, bool records) {
  ScmContact::Settings settings;
  if (options.given("contact_width")) settings.width = options.number("contact_width");
  settings.records = records;
  return settings;
}

}  // namespace

const StyleRow contact_scm_style =
    fix_style<FixContactScm>("contact/scm", "contact", "contact/fix_contact_scm.md");

Schema FixContactScm::schema() {
  Schema schema("fix contact/scm");
  declare_body(schema);
  schema.text("terrain", "id of the fix of the height field");
  schema
      .number("contact_width", "m", Range::positive(),
              "width b in k_c/b; by default that of the present contact patch")
      .optional();
  return schema;
}

const Outputs<FixContactScm>& FixContactScm::outputs() {
  using Fix = FixContactScm;
  static const Outputs<Fix> list = {
      {"force_x", "N", "force on the body in the last sub-step",
       [](Fix& fix) { return fix.of_whole(fix.contact_.step().force).x(); }},
      {"force_y", "N", "force on the body in the last sub-step",
       [](Fix& fix) { return fix.of_whole(fix.contact_.step().force).y(); }},
      {"force_z", "N", "force on the body in the last sub-step",
       [](Fix& fix) { return fix.of_whole(fix.contact_.step().force).z(); }},
      {"area", "m^2", "contact area, seen from above",
       [](Fix& fix) { return fix.symmetry_factor() * fix.contact_.step().area; }},
      {"width", "m", "width b in k_c/b; 0 without contact or k_c",
       [](Fix& fix) { return fix.contact_.step().width; }},
      {"pressure", "Pa", "largest pressure", [](Fix& fix) { return fix.contact_.step().pressure; }},
      {"sinkage", "m", "largest sinkage of a cell",
       [](Fix& fix) { return fix.contact_.step().sinkage; }},
      {"stored_energy", "J", "elastic energy of the soil below the body",
       [](Fix& fix) { return fix.symmetry_factor() * fix.contact_.step().stored; }},
      {"compaction_loss", "J", "plastic work of the pressure since the start",
       [](Fix& fix) { return fix.symmetry_factor() * fix.contact_.losses().compaction; }},
      {"shear_loss", "J", "work of the shear stress since the start",
       [](Fix& fix) { return fix.symmetry_factor() * fix.contact_.losses().shear; }},
      {"damping_loss", "J", "work of the damping since the start",
       [](Fix& fix) { return fix.symmetry_factor() * fix.contact_.losses().damping; }},
  };
  return list;
}

FixScm& FixContactScm::find_terrain() {
  auto& fix = use<FixScm>("terrain", {"scm"});
  require_unique<FixContactScm>(
      *modify, options().subject(), fmt::format("presses '{}' on '{}'", body_fix().id, fix.id),
      "one contact for each pair", [&](FixContactScm& other) {
        return &other.body_fix() == &body_fix() && &other.terrain_fix_ == &fix;
      });
  return fix;
}

FixContactScm::FixContactScm(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixContact(lammps, narg, arg, schema()),
      terrain_fix_(find_terrain()),
      contact_(body(), terrain_fix_.field(), terrain_fix_.soil(),
               settings_from(options(), comm->me == 0)) {
  contribute(static_cast<Contact&>(contact_));
  provide(outputs());
}

/// Of a wheel on this ground, the plastic work is compaction and the shear friction.
void FixContactScm::add_losses(const Body& wheel, GroundLosses& losses) const {
  if (&wheel != &body()) return;
  const ScmContact::Losses& own = contact_.losses();
  losses.compaction += symmetry_factor() * own.compaction;
  losses.continuum += symmetry_factor() * own.compaction;
  losses.friction += symmetry_factor() * own.shear;
  losses.contact_damping += symmetry_factor() * own.damping;
}

/// A mass m on a spring k with a dashpot c is stable for steps of dt up to k = 4 m/dt^2 and, with
/// damping that lags by half a step, c = m/dt. Of a tyre all are those of an area of its tread, of
/// a wheel those of its largest contact, half its outline.
void FixContactScm::check_stability() {
  double mass, step = update->dt;
  if (const auto* tyre = dynamic_cast<const Tyre*>(&body())) {
    step = std::min(step, tyre->stable_time_step());
    mass = tyre->tread_mass();
  } else if (const auto* wheel = dynamic_cast<const WheelHub*>(&body())) {
    mass = wheel->total_mass() / (wheel->nominal_radius() * wheel->nominal_width());
  } else {
    return;  // the motion of a plate is prescribed
  }
  const auto refuse_above = [&](const char* key, double value, double limit, const char* unit) {
    if (value > limit)
      throw InputError(
          terrain_fix_.options().where(key), fmt::format("is {:g} {}", value, unit),
          fmt::format("at most {:.2g} {} under '{}'", limit, unit, body_fix().id),
          fmt::format("the body has {:.3g} kg/m^2 of contact and steps of {:.2g} s", mass, step));
  };
  const Soil& soil = terrain_fix_.soil();
  refuse_above("stiffness", soil.stiffness, 4.0 * mass / (step * step), "Pa/m");
  refuse_above("damping", soil.damping, mass / step, "Pa s/m");
}

}  // namespace furrow::coupling

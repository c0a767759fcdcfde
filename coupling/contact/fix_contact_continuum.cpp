// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/fix_contact_continuum.h"

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "coupling/contact/body_material.h"
#include "coupling/liggghts/styles/style_registry.h"

namespace furrow::coupling {

const StyleRow contact_continuum_style = fix_style<FixContactContinuum>(
    "contact/continuum", "contact", "contact/fix_contact_continuum.md", {"contact/bodies"});

Schema FixContactContinuum::schema() {
  Schema schema = ContactParameters::schema("fix contact/continuum");
  declare_body(schema);
  declare_body_material(schema);
  schema.text("terrain", "id of the fix of the terrain");
  schema.alias("ground", "terrain");
  return schema;
}

const Outputs<FixContactContinuum>& FixContactContinuum::outputs() {
  using Fix = FixContactContinuum;
  static const Outputs<Fix> list = {
      {"force_x", "N", "force on the body in the last sub-step",
       [](Fix& fix) { return fix.to_whole(fix.contact_.force()).x(); }},
      {"force_y", "N", "force on the body in the last sub-step",
       [](Fix& fix) { return fix.to_whole(fix.contact_.force()).y(); }},
      {"force_z", "N", "force on the body in the last sub-step",
       [](Fix& fix) { return fix.to_whole(fix.contact_.force()).z(); }},
      {"contacts", "", "particles in contact",
       [](Fix& fix) { return fix.symmetry_factor() * fix.contact_.contacts(); }},
      {"area", "m^2", "surface area of the particles in contact",
       [](Fix& fix) { return fix.symmetry_factor() * fix.contact_.area(); }},
      {"penetration", "m", "present largest penetration",
       [](Fix& fix) { return fix.contact_.penetration(); }},
      {"deepest_penetration", "m", "largest penetration since the start",
       [](Fix& fix) { return fix.contact_.deepest_penetration(); }},
      {"friction_loss", "J", "energy dissipated by friction since the start",
       [](Fix& fix) { return fix.friction_loss(); }},
      {"damping_loss", "J", "energy dissipated by damping since the start",
       [](Fix& fix) { return fix.damping_loss(); }},
  };
  return list;
}

/// A half body needs half the terrain with the same plane of symmetry, y = 0. @throws InputError
void FixContactContinuum::check_terrain() const {
  const FixTerrain& fix = terrain_fix();
  if (fix.options().flag("multirate"))
    throw InputError(
        options().where("terrain"), fmt::format("is '{}', which has 'multirate yes'", fix.id),
        "terrain that steps with what presses on it", "write 'multirate no' in the terrain's line");
  const double plane = fix.terrain().grid().axis(1).lower();
  if (!body().half_model() || (fix.half_model() && plane == 0.0)) return;
  const std::string& body_id = options().text("body");
  throw InputError(
      options().where("body"),
      fix.half_model()
          ? fmt::format("is the half y >= 0 of '{}', and the terrain's plane of symmetry is y = "
                        "{:.4g} m",
                        body_id, plane)
          : fmt::format("is '{}', which is a half model, and the terrain is whole", body_id),
      "a half model on half a terrain with the same plane",
      "give the terrain 'symmetry yes' and its centre y = 0, or the body 'half no'");
}

void FixContactContinuum::add_losses(const Body& wheel, GroundLosses& losses) const {
  if (&wheel != &body()) return;
  const double terrain_factor = terrain_fix().symmetry_factor();
  const TerrainWork work = terrain_fix().terrain().work();
  losses.compaction += terrain_factor * work.compaction;
  losses.bulldozing += terrain_factor * work.bulldozing;
  losses.kinetic += terrain_factor * work.kinetic;
  losses.numerical += terrain_factor * work.numerical_loss;
  losses.radiated += terrain_factor * work.radiated;
  losses.friction += friction_loss();
  losses.contact_damping += damping_loss();
  losses.continuum += terrain_factor * contact_.terrain_work();
}

ContactParameters FixContactContinuum::parameters() {
  check_terrain();
  warn_of_slip_length(*lmp, options());
  if (options().text("surface") != "frictional") return ContactParameters::from(options());
  return ContactParameters::from(
      options(),
      contact_with(
          *lmp, options(), body_fix(), body_material(options(), body_fix()), ground(),
          ContactParameters::unknown(),
          fmt::format("{:g} and {:g} m hold, and a slip_length of 0 m gives a driven wheel "
                      "too much traction at small slips",
                      ContactParameters::unknown().friction,
                      ContactParameters::unknown().slip_length)));
}

/// Settings with the friction in effect, from the line or from the ground.
std::vector<std::pair<std::string, std::string>> FixContactContinuum::settings() const {
  auto list = FixContact::settings();
  put_effective(list, parameters_.friction, parameters_.slip_length);
  return list;
}

/// A half body mirrors what it is given itself; a whole one on half the terrain needs the forces of
/// the other half as well.
FixContactContinuum::FixContactContinuum(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixContactWith(lammps, narg, arg, schema(), "terrain"),
      parameters_(parameters()),
      contact_(body(), terrain_fix().terrain(), parameters_,
               terrain_fix().half_model() && !body().half_model(), name()) {
  contribute(static_cast<Contact&>(contact_));
  provide(outputs());
}

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/fix_contact_rft.h"

#include <fmt/format.h>

#include "furrow/bodies/rigid_plate.h"
#include "furrow/bodies/rigid_wheel.h"
#include "comm.h"
#include "furrow/core/options/check_number.h"
#include "coupling/liggghts/styles/style_registry.h"

namespace furrow::coupling {

const StyleRow contact_rft_style =
    fix_style<FixContactRft>("contact/rft", "contact", "contact/fix_contact_rft.md");

Schema FixContactRft::schema() {
  Schema schema("fix contact/rft");
  declare_body(schema);
  declare_field(schema);
  schema.number("xi", "N/m^3", Range::closed(1e3, 1e9),
                "strength of the sand: gradient of the pressure under a plate over 0.875");
  schema.number("friction", "", Range::non_negative(),
                "friction coefficient of the body's surface and the sand");
  schema
      .number("slip_length", "m", Range::closed(1e-5, 0.1),
              "distance by which a face moves until the sand resists")
      .by_default(1e-3);
  return schema;
}

const Outputs<FixContactRft>& FixContactRft::outputs() {
  using Fix = FixContactRft;
  static const Outputs<Fix> list = {
      {"force_x", "N", "force on the body in the last sub-step",
       [](Fix& fix) { return fix.contact_.step().force.x(); }},
      {"force_y", "N", "force on the body in the last sub-step",
       [](Fix& fix) { return fix.contact_.step().force.y(); }},
      {"force_z", "N", "force on the body in the last sub-step",
       [](Fix& fix) { return fix.contact_.step().force.z(); }},
      {"area", "m^2", "area of the faces that press on sand",
       [](Fix& fix) { return fix.contact_.step().area; }},
      {"pressure", "Pa", "largest pressure on a face",
       [](Fix& fix) { return fix.contact_.step().pressure; }},
      {"sinkage", "m", "largest depth of a node below the surface",
       [](Fix& fix) { return fix.contact_.step().sinkage; }},
      {"pressure_loss", "J", "work of the pressure since the start",
       [](Fix& fix) { return fix.contact_.losses().pressure; }},
      {"shear_loss", "J", "work of the stress along the faces since the start",
       [](Fix& fix) { return fix.contact_.losses().shear; }},
  };
  return list;
}

/// @throws InputError for a tyre, which deforms
Body& FixContactRft::rigid_body() const {
  const bool rigid = dynamic_cast<const RigidWheel*>(&body()) != nullptr ||
                     dynamic_cast<const RigidPlate*>(&body()) != nullptr;
  need(rigid, options().where("body"),
       fmt::format("is '{}', which is not a rigid body", body_fix().id),
       "a wheel/rigid, wheel/mesh, plate/rigid or plate/mesh",
       "use contact/scm or terrain/continuum for a tyre");
  return body();
}

RftContact::Settings FixContactRft::settings_of_contact() const {
  RftContact::Settings settings;
  settings.strength = options().number("xi");
  settings.friction = options().number("friction");
  settings.slip_length = options().number("slip_length");
  settings.records = comm->me == 0;
  return settings;
}

FixContactRft::FixContactRft(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixFieldContact(lammps, narg, arg, schema()),
      contact_(rigid_body(), field(), settings_of_contact()) {
  contribute(static_cast<Contact&>(contact_));
  provide(outputs());
}

/// The work of the pressure moves sand, as in a continuum.
void FixContactRft::add_losses(const Body& wheel, GroundLosses& losses) const {
  if (&wheel != &body()) return;
  const RftContact::Losses& own = contact_.losses();
  losses.compaction += own.pressure;
  losses.continuum += own.pressure;
  losses.friction += own.shear;
}

}  // namespace furrow::coupling

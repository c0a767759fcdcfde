// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/fix_contact_continuum.h"

#include <fmt/format.h>

#include "comm.h"
#include "core/error.h"
#include "coupling/terrain/fix_terrain_continuum.h"
#include "coupling/liggghts/errors.h"
#include "coupling/base/restart_record.h"
#include "coupling/base/args.h"
#include "modify.h"

namespace furrow::coupling {

Schema FixContactBodies::schema() {
  Schema schema = ContactParameters::schema("fix contact/bodies");
  schema.text("body", "id of the fix of the wheel, tyre or plate");
  schema.text("ground", "id of the fix terrain/continuum");
  return schema;
}

FixContactBodies::FixContactBodies(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg), options_(schema().read(args_after_style(narg, arg))) {
  Body& body =
      FixCoupledSystem::find_body(*lammps, options_.where("body"), options_.text("body")).body();
  auto* ground = dynamic_cast<FixTerrainContinuum*>(
      &FixCoupledSystem::find_body(*lammps, options_.where("ground"), options_.text("ground")));
  if (!ground)
    throw InputError(options_.where("ground"),
                     fmt::format("is '{}', which is a body but no ground", options_.text("ground")),
                     "the id of a fix terrain/continuum");
  if (body.surface().triangle_count() == 0)
    throw InputError(options_.where("body"),
                     fmt::format("is '{}', which has no surface", options_.text("body")),
                     "a wheel, a tyre or a plate");
  body_fix_ = lammps->modify->find_fix_id(options_.text("body").c_str());
  terrain_fix_ = lammps->modify->find_fix_id(options_.text("ground").c_str());
  const double plane = ground->ground().grid().axis(1).lower();
  half_body_ = body.half_model();
  if (half_body_ && !(ground->half_model() && plane == 0.0))
    throw InputError(
        options_.where("body"),
        ground->half_model()
            ? fmt::format(
                  "is the half y >= 0 of '{}', and the ground's plane of symmetry is y = {:.4g} m",
                  options_.text("body"), plane)
            : fmt::format("is '{}', which is a half model, and the ground is whole",
                          options_.text("body")),
        "a half model on half a ground with the same plane",
        "give the ground 'symmetry yes' and its centre y = 0, or the body 'half no'");
  // A half body mirrors what it is given itself; a whole one needs the forces of the other half as
  // well.
  contact_ = std::make_unique<TerrainContact>(
      body, ground->ground(), ContactParameters::from(options_),
      ground->half_model() && !half_body_, fmt::format("fix {} contact/bodies", id));
  restart_global = 1;
  vector_flag = 1;
  size_vector = 9;
  global_freq = 1;
  extvector = 0;
}

void FixContactBodies::post_create() { FixCoupledSystem::of(*lmp).add(*contact_, id); }

void FixContactBodies::pre_delete(bool unfixflag) {
  if (unfixflag) FixCoupledSystem::of(*lmp).remove(*contact_);
}

void FixContactBodies::write_restart(FILE* file) {
  if (comm->me != 0) return;
  Checkpoint state(style);
  contact_->checkpoint(state);
  with_local_errors(*error, [&] { write_record(file, state); });
}

void FixContactBodies::restart(char* buffer) {
  with_collective_errors(*error, [&] {
    Checkpoint state = read_record(style, buffer);
    contact_->checkpoint(state);
    state.finish();
  });
}

double FixContactBodies::compute_vector(int n) {
  const TerrainContact& c = *contact_;
  const double both = half_body_ ? 2.0 : 1.0;
  const double values[] = {both * c.force().x(),    half_body_ ? 0.0 : c.force().y(),
                           both * c.force().z(),    both * c.contacts(),
                           both * c.area(),         c.penetration(),
                           c.deepest_penetration(), both * c.friction_loss(),
                           both * c.damping_loss()};
  return values[n];
}

}  // namespace furrow::coupling

#include "coupling/fix_contact_bodies.h"

#include <fmt/format.h>

#include "comm.h"
#include "core/error.h"
#include "coupling/fix_terrain_continuum.h"
#include "coupling/guard.h"
#include "coupling/restart_record.h"
#include "coupling/words.h"
#include "modify.h"

namespace furrow::coupling {

Schema FixContactBodies::schema() {
  Schema schema = GroundContact::schema("fix contact/bodies");
  schema.text("body", "id of the fix of the wheel, tyre or plate");
  schema.text("ground", "id of the fix terrain/continuum");
  return schema;
}

FixContactBodies::FixContactBodies(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg), options_(schema().read(words_after_style(narg, arg))) {
  Body& body = FixWorld::find_body(*lammps, options_.where("body"), options_.word("body")).body();
  auto* ground =
      dynamic_cast<FixTerrainContinuum*>(&FixWorld::find_body(*lammps, options_.where("ground"), options_.word("ground")));
  if (!ground)
    throw InputError(options_.where("ground"),
                     fmt::format("is '{}', which is a body but no ground", options_.word("ground")),
                     "the id of a fix terrain/continuum");
  if (body.surface().triangle_count() == 0)
    throw InputError(options_.where("body"), fmt::format("is '{}', which has no surface", options_.word("body")),
                     "a wheel, a tyre or a plate");
  body_fix_ = lammps->modify->find_fix_id(options_.word("body").c_str());
  ground_fix_ = lammps->modify->find_fix_id(options_.word("ground").c_str());
  contact_ = std::make_unique<GroundContact>(body, ground->ground(), GroundContact::parameters_from(options_),
                                             ground->half_model(), fmt::format("fix {} contact/bodies", id));
  restart_global = 1;
  vector_flag = 1;
  size_vector = 9;
  global_freq = 1;
  extvector = 0;
}

void FixContactBodies::post_create() { FixWorld::of(*lmp).add(*contact_, id); }

void FixContactBodies::pre_delete(bool unfixflag) {
  if (unfixflag) FixWorld::of(*lmp).remove(*contact_);
}

void FixContactBodies::write_restart(FILE* file) {
  if (comm->me != 0) return;
  write_record(file, contact_->state());
}

void FixContactBodies::restart(char* buffer) {
  const auto* numbers = reinterpret_cast<const double*>(buffer);
  contact_->restore({numbers, numbers + contact_->state().size()});
}

double FixContactBodies::compute_vector(int n) {
  const GroundContact& c = *contact_;
  const double values[] = {c.force().x(),   c.force().y(),           c.force().z(),     c.contacts(),    c.area(),
                           c.penetration(), c.deepest_penetration(), c.friction_loss(), c.damping_loss()};
  return values[n];
}

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/fix_contact_plane.h"

#include "comm.h"
#include "coupling/bodies/fix_coupled_system.h"
#include "coupling/base/restart_record.h"
#include "coupling/liggghts/errors.h"
#include "coupling/base/args.h"
#include "modify.h"

namespace furrow::coupling {

struct FixContactPlane::PlaneContact : public Contact {
  PlaneContact(Body& touching, const RigidPlaneParameters& parameters)
      : body(touching), plane(parameters, touching.surface()) {}
  void apply(double) override { plane.press_on(body.surface()); }

  Body& body;
  RigidPlane plane;
};

Schema FixContactPlane::schema() {
  Schema schema("fix contact/plane");
  schema.text("body", "id of the fix of the wheel, tyre or plate");
  schema.number("level", "m", Range::any(), "z of the floor");
  schema.number("friction", "", Range::non_negative(), "Coulomb's mu");
  schema.number("stiffness", "Pa/m", Range::positive(), "pressure per penetration").by_default(2e9);
  schema
      .number("tangential_stiffness", "Pa/m", Range::positive(),
              "shear stress per displacement while a node sticks")
      .by_default(1e9);
  schema.number("damping", "Pa s/m", Range::non_negative(), "pressure per approach velocity")
      .by_default(0.0);
  return schema;
}

FixContactPlane::FixContactPlane(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg), options_(schema().read(args_after_style(narg, arg))) {
  Body& body =
      FixCoupledSystem::find_body(*lammps, options_.where("body"), options_.text("body")).body();
  body_fix_ = lammps->modify->find_fix_id(options_.text("body").c_str());
  RigidPlaneParameters plane;
  plane.height = options_.number("level");
  plane.friction = options_.number("friction");
  plane.stiffness = options_.number("stiffness");
  plane.tangential_stiffness = options_.number("tangential_stiffness");
  plane.damping = options_.number("damping");
  contact_ = std::make_unique<PlaneContact>(body, plane);
  restart_global = 1;
  vector_flag = 1;
  size_vector = 5;
  global_freq = 1;
  extvector = 0;
}

FixContactPlane::~FixContactPlane() = default;

void FixContactPlane::post_create() { FixCoupledSystem::of(*lmp).add(*contact_, id); }

void FixContactPlane::pre_delete(bool unfixflag) {
  if (unfixflag) FixCoupledSystem::of(*lmp).remove(*contact_);
}

/// Where nodes stick.
void FixContactPlane::write_restart(FILE* file) {
  if (comm->me != 0) return;
  Checkpoint state(style);
  contact_->plane.checkpoint(state);
  with_local_errors(*error, [&] { write_record(file, state); });
}

void FixContactPlane::restart(char* buffer) {
  with_collective_errors(*error, [&] {
    Checkpoint state = read_record(style, buffer);
    contact_->plane.checkpoint(state);
    state.finish();
  });
}

double FixContactPlane::compute_vector(int n) {
  const RigidPlane& plane = contact_->plane;
  if (n < 3) return plane.total_force()[n];
  if (n == 3) return plane.pressure().maxCoeff();
  double area = 0.0;
  for (Eigen::Index i = 0; i < plane.area().size(); ++i)
    if (plane.pressure()[i] > 0.0) area += plane.area()[i];
  return area;
}

}  // namespace furrow::coupling

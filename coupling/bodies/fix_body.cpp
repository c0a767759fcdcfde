// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/bodies/fix_body.h"

#include <fmt/format.h>

#include "comm.h"
#include "coupling/base/uses_fix.h"
#include "coupling/liggghts/errors.h"
#include "coupling/base/restart_record.h"

namespace furrow::coupling {

FixBody::FixBody(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, std::unique_ptr<Body> body)
    : Fix(lammps, narg, arg), body_(std::move(body)) {
  restart_global = 1;
  can_create_mesh_ = true;
}

FixBody::~FixBody() = default;

/// Not in the constructor: LIGGGHTS cannot make one fix while it makes another.
void FixBody::post_create() { FixCoupledSystem::of(*lmp).add(*body_, id); }

void FixBody::pre_delete(bool unfixflag) {
  if (!unfixflag) return;
  with_collective_errors(*error, [&] { forbid_removal_while_used(*modify, *this); });
  FixCoupledSystem::of(*lmp).remove(*body_);
}

/// Collective where a body is spread over the ranks.
void FixBody::write_restart(FILE* file) {
  with_collective_errors(*error, [&] {
    Checkpoint state(owner());
    body_->checkpoint(state);
    if (comm->me == 0) write_record(file, state);
  });
}

void FixBody::restart(char* buffer) {
  with_collective_errors(*error, [&] {
    Checkpoint made(owner());
    body_->checkpoint(made);
    state_as_made_ = made.reread();
    Checkpoint state = read_record(owner(), buffer);
    body_->checkpoint(state);
    state.finish();
  });
}

std::string FixBody::owner() const { return fmt::format("fix {} {}", id, style); }

int FixBody::getCreateMeshTriCount() { return static_cast<int>(body_->surface().triangle_count()); }

double* FixBody::getCreateMeshTriNode(const int i) {
  Surface& surface = body_->surface();
  return surface.x.col(surface.triangles[static_cast<std::size_t>(i / 3)][i % 3]).data();
}

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/fix_body.h"

namespace furrow::coupling {

FixBody::FixBody(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Schema& schema,
                 const MakeBody& make_body)
    : FurrowFix(lammps, narg, arg, schema),
      body_(make_body(options())),
      nodes_as_made_(body_->surface().x) {
  contribute(*body_);
  keep_state();
  can_create_mesh_ = true;
}

void FixBody::restart(char* buffer) {
  collectively([&] {
    Checkpoint made(name());
    body_->checkpoint(made);
    state_as_made_ = made.reread();
  });
  FurrowFix::restart(buffer);
}

int FixBody::getCreateMeshTriCount() { return static_cast<int>(body_->surface().triangle_count()); }

double* FixBody::getCreateMeshTriNode(const int i) {
  Surface& surface = body_->surface();
  return surface.x.col(surface.triangles[static_cast<std::size_t>(i / 3)][i % 3]).data();
}

}  // namespace furrow::coupling

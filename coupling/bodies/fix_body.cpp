// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/bodies/fix_body.h"

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
void FixBody::post_create() { FixWorld::of(*lmp).add(*body_, id); }

void FixBody::pre_delete(bool unfixflag) {
  if (!unfixflag) return;
  guarded(*error, [&] { refuse_if_needed(*modify, *this); });
  FixWorld::of(*lmp).remove(*body_);
}

void FixBody::write_restart(FILE* file) {
  std::vector<double> state = body_->state();  // collective where a body is spread over the ranks
  if (comm->me != 0) return;
  state.insert(state.begin(), static_cast<double>(state.size()));
  write_record(file, state);
}

void FixBody::restart(char* buffer) {
  const auto* numbers = reinterpret_cast<const double*>(buffer);
  state_as_made_ = body_->state();
  guarded(*error, [&] {
    body_->restore(
        std::vector<double>(numbers + 1, numbers + 1 + static_cast<std::size_t>(numbers[0])));
  });
}

int FixBody::getCreateMeshTriCount() { return static_cast<int>(body_->surface().triangle_count()); }

double* FixBody::getCreateMeshTriNode(const int i) {
  Surface& surface = body_->surface();
  return surface.x.col(surface.triangles[static_cast<std::size_t>(i / 3)][i % 3]).data();
}

}  // namespace furrow::coupling

#include "coupling/fix_body.h"

#include "comm.h"
#include "coupling/dependent.h"
#include "coupling/guard.h"

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
  const std::vector<double> state = body_->state();  // collective where a body is spread over the ranks
  if (comm->me != 0) return;
  const int size = static_cast<int>(state.size() * sizeof(double) + sizeof(double));
  const double count = static_cast<double>(state.size());
  std::fwrite(&size, sizeof size, 1, file);
  std::fwrite(&count, sizeof count, 1, file);
  std::fwrite(state.data(), sizeof(double), state.size(), file);
}

void FixBody::restart(char* buffer) {
  const auto* numbers = reinterpret_cast<const double*>(buffer);
  state_as_made_ = body_->state();
  guarded(*error,
          [&] { body_->restore(std::vector<double>(numbers + 1, numbers + 1 + static_cast<std::size_t>(numbers[0]))); });
}

int FixBody::getCreateMeshTriCount() { return static_cast<int>(body_->surface().triangle_count()); }

double* FixBody::getCreateMeshTriNode(const int i) {
  Surface& surface = body_->surface();
  return surface.x.col(surface.triangles[static_cast<std::size_t>(i / 3)][i % 3]).data();
}

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
// Checkpoints of continuum terrain.
#include "mpm/continuum_terrain.h"

namespace furrow {

/// Sums of all ranks are saved, and go to rank 0 when they are restored.
void ContinuumTerrain::checkpoint_totals(Checkpoint& state) {
  double* totals[] = {&totals_.kinetic_energy,
                      &totals_.momentum[0],
                      &totals_.momentum[1],
                      &totals_.momentum[2],
                      &initial_,
                      &stress_work_,
                      &contact_work_,
                      &gravity_work_,
                      &dropped_kinetic_,
                      &dropped_internal_,
                      &dropped_dissipated_};
  std::vector<double> sums;
  for (const double* total : totals) sums.push_back(*total);
  if (state.saving()) ranks().sum(sums.data(), sums.size());
  state.values("totals", sums.data(), sums.size());
  if (state.saving()) return;
  for (std::size_t n = 0; n < sums.size(); ++n) *totals[n] = ranks().rank() == 0 ? sums[n] : 0.0;
}

void ContinuumTerrain::checkpoint_rut(Checkpoint& state) {
  std::vector<double> rut;
  for (const RutPoint& point : rut_)
    rut.insert(rut.end(), {point.x, point.y, point.z, point.density});
  if (state.saving()) rut = ranks().gather(rut);
  state.values("rut", rut);
  if (state.saving()) return;
  rut_.clear();
  if (ranks().rank() != 0) return;
  for (std::size_t n = 0; n + 3 < rut.size(); n += 4)
    rut_.push_back({rut[n], rut[n + 1], rut[n + 2], rut[n + 3]});
}

/// Records of Particles::pack(), of all ranks.
void ContinuumTerrain::checkpoint_particles(Checkpoint& state) {
  for (ParticleGroup& group : groups_) {
    const std::size_t length = group.particles.record_length();
    std::vector<double> records;
    if (state.saving()) {
      for (std::size_t p = 0; p < group.particles.size(); ++p) group.particles.pack(p, records);
      records = ranks().gather(records);
    }
    state.values("particles", records);
    if (state.saving()) continue;
    group.particles.reorder({});
    for (const double *next = records.data(), *end = next + records.size(); next != end;
         next += length)
      if (partition_.owner(grid_.axis(0).cell_of(next[0])) == ranks().rank())
        group.particles.unpack(next);
  }
}

void ContinuumTerrain::checkpoint(Checkpoint& state) {
  for (int a = 0; a < 3; ++a) {
    state.match("cells", grid_.axis(a).cells());
    state.match("shortest_cell", grid_.axis(a).shortest());
  }
  state.match("layers", groups_.size());
  for (const ParticleGroup& group : groups_) {
    state.match("numbers_of_a_particle", group.particles.record_length());
    state.match("density", group.material->density());
  }
  state.match("surface_nodes", free_surface_.surface().node_count());
  checkpoint_totals(state);
  int shifts = shifts_;
  state.value("shifts", shifts);
  grid_.shift_x(shifts - shifts_);
  shifts_ = shifts;
  state.value("focus", focus_);
  state.value("next_id", next_id_);
  state.value("drift", drift_);
  state.value("travel", travel_);
  double largest_speed = ranks().max(largest_speed_);
  state.value("largest_speed", largest_speed);
  if (!state.saving()) largest_speed_ = largest_speed;
  state.value("steps_to_remap", steps_left_);
  state.value("unsynchronised", unsynchronised_);
  grid_.checkpoint(state, ranks(), partition_.owned());
  checkpoint_rut(state);
  state.values("free_surface_force", free_surface_.surface().f);
  if (state.saving()) {
    Boundary boundary = boundary_;
    boundary.synchronise(ranks(), partition_.owned());
    boundary.collect(ranks());
    boundary.checkpoint(state, true);
  } else {
    boundary_.checkpoint(state, ranks().rank() == 0);
  }
  checkpoint_particles(state);
  if (!state.saving()) resume();
}

/// What follows from the restored particles and nodes.
void ContinuumTerrain::resume() {
  const double drift = drift_;
  if (ranks().size() > 1) sort();
  drift_ = drift;
  ++generation_;
  if (remap_pending()) {
    grid_.clear_sums(partition_.touched());
    scatter_stress_forces();
  }
  if (!free_surface_.exists()) return;
  free_surface_.relocate(groups_);
  update_free_surface();
}

}  // namespace furrow

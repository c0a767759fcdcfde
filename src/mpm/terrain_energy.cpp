// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/terrain_energy.h"

#include <iterator>

namespace furrow {

double sum_energy(const std::vector<ParticleGroup>& groups, std::size_t field) {
  double sum = 0.0;
  for (const ParticleGroup& group : groups) {
    const double* volume = group.particles.data(column::volume);
    const double* energy = group.particles.data(column::state + field);
    for (std::size_t p = 0; p < group.particles.size(); ++p) sum += volume[p] * energy[p];
  }
  return sum;
}

double internal_energy(const std::vector<ParticleGroup>& groups) {
  return sum_energy(groups, field::stored_energy) + sum_energy(groups, field::frozen_energy) +
         sum_energy(groups, field::dissipated_energy);
}

Vector3 momentum_of(const std::vector<ParticleGroup>& groups) {
  Vector3 momentum = Vector3::Zero();
  for (const ParticleGroup& group : groups)
    for (std::size_t p = 0; p < group.particles.size(); ++p)
      momentum += group.mass(p) * group.particles.velocity(p);
  return momentum;
}

void TerrainEnergy::add_removed(double internal, double dissipated) {
  removed_internal_ += internal;
  removed_dissipated_ += dissipated;
}

/// The numerical loss is what the works leave unexplained of the kinetic energy of the nodes: what
/// the remap takes.
EnergyBudget TerrainEnergy::energy_budget(const std::vector<ParticleGroup>& groups,
                                          const Vector3& momentum, double boundary_work,
                                          const Communicator& ranks) const {
  const double plastic = sum_energy(groups, field::dissipated_energy) + removed_dissipated_;
  const double kinetic = nodes_.kinetic_energy + removed_kinetic_;
  const double stored = internal_energy(groups) - initial_ + removed_internal_ - plastic;
  const double load_work = gravity_work_ + boundary_work;
  const double numerical_loss = contact_work_ + load_work - stress_work_ - slide_loss_ - kinetic;
  double sums[] = {kinetic,        stored,       plastic + slide_loss_, contact_work_, load_work,
                   numerical_loss, momentum.x(), momentum.y(),          momentum.z()};
  ranks.sum(sums, std::size(sums));
  EnergyBudget budget;
  budget.kinetic_energy = sums[0];
  budget.stored_energy = sums[1];
  budget.dissipated_energy = sums[2];
  budget.contact_work = sums[3];
  budget.load_work = sums[4];
  budget.numerical_loss = sums[5];
  budget.momentum = {sums[6], sums[7], sums[8]};
  return budget;
}

TerrainWork TerrainEnergy::work(double boundary_work, const Communicator& ranks) const {
  const double kinetic = nodes_.kinetic_energy + removed_kinetic_;
  double sums[] = {
      contact_work_, stress_work_ + slide_loss_, vertical_stress_work_, gravity_work_, kinetic,
      boundary_work};
  ranks.sum(sums, std::size(sums));
  TerrainWork work;
  work.contact = sums[0];
  work.compaction = sums[2];
  work.bulldozing = sums[1] - sums[2] - sums[3];
  work.kinetic = sums[4];
  work.radiated = -sums[5];
  work.numerical_loss =
      work.contact - work.compaction - work.bulldozing - work.kinetic - work.radiated;
  return work;
}

void TerrainEnergy::checkpoint(Checkpoint& state, const Communicator& ranks) {
  double* totals[] = {&nodes_.kinetic_energy,
                      &nodes_.momentum[0],
                      &nodes_.momentum[1],
                      &nodes_.momentum[2],
                      &initial_,
                      &stress_work_,
                      &contact_work_,
                      &gravity_work_,
                      &removed_kinetic_,
                      &removed_internal_,
                      &removed_dissipated_,
                      &vertical_stress_work_,
                      &slide_loss_};
  std::vector<double> sums;
  for (const double* total : totals) sums.push_back(*total);
  if (state.saving()) ranks.sum(sums.data(), sums.size());
  state.values("totals", sums.data(), sums.size());
  for (std::size_t n = 0; n < sums.size(); ++n) *totals[n] = ranks.rank() == 0 ? sums[n] : 0.0;
}

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Energies of a terrain and the works done on it since the start.

#include <cstddef>
#include <vector>

#include "furrow/bodies/body.h"
#include "furrow/core/checkpoint.h"
#include "furrow/core/communicator.h"
#include "furrow/mpm/grid/grid.h"
#include "furrow/mpm/particles/particle_group.h"
#include "furrow/mpm/transfer/transfer.h"

namespace furrow {

/// Sum over this rank's particles of a field per reference volume [J].
/// @param field  of the material's state: field::stored_energy, field::dissipated_energy ...
double sum_energy(const std::vector<ParticleGroup>& groups, std::size_t field);
/// Stored, frozen and dissipated energy of this rank's particles [J].
double internal_energy(const std::vector<ParticleGroup>& groups);
Vector3 momentum_of(const std::vector<ParticleGroup>& groups);  ///< this rank's share [N s]

/// Work of contacts on a terrain since the start, by its use [J] (theory: resistance, eqs. 2 to 4):
/// contact = compaction + bulldozing + kinetic + numerical_loss + radiated.
struct TerrainWork {
  double contact = 0.0;         ///< of contacts on the terrain
  double compaction = 0.0;      ///< by pressing down
  double bulldozing = 0.0;      ///< by all other deformation and by lifting
  double kinetic = 0.0;         ///< energy of its motion, that of removed ground included
  double numerical_loss = 0.0;  ///< loss to the discretisation
  double radiated = 0.0;        ///< through absorbing faces
};

/// Holds this rank's share of every sum; energy_budget() adds up the ranks.
class TerrainEnergy {
 public:
  // Works of a step [J].
  /// Adds one half of the trapezoidal stress work: 0.5 x (stress at one end of the step) : (strain
  /// increment).
  void add_half_stress_work(const StressWork& work) {
    stress_work_ += 0.5 * work.total;
    vertical_stress_work_ += 0.5 * work.vertical;
  }
  void add_contact_work(double work) { contact_work_ += work; }
  double contact_work() const { return contact_work_; }  ///< this rank's share [J]
  void add_gravity_work(double work) { gravity_work_ += work; }
  /// Adds the heat from friction on a slide surface in a step [J].
  void add_slide_loss(double loss) { slide_loss_ += loss; }
  double slide_loss() const { return slide_loss_; }  ///< this rank's share [J]
  /// Momentum and kinetic energy of the nodes after a step.
  void set_node_totals(const NodeTotals& totals) { nodes_ = totals; }
  const NodeTotals& node_totals() const { return nodes_; }

  /// Ground that a fill or a moving window added had this internal energy [J].
  void add_initial(double internal) { initial_ += internal; }
  /// Ground that a moving window removed [J]; kinetic energy particle by particle.
  void add_removed_kinetic(double energy) { removed_kinetic_ += energy; }
  void add_removed(double internal, double dissipated);

  /// Energy budget of all ranks. Collective.
  /// @param momentum       of this rank's share of the ground [N s]
  /// @param boundary_work  of the absorbing faces, this rank's share [J]
  EnergyBudget energy_budget(const std::vector<ParticleGroup>& groups, const Vector3& momentum,
                             double boundary_work, const Communicator& ranks) const;

  /// Work of contacts, by its use. Collective, and cheap: no particle is looked at.
  TerrainWork work(double boundary_work, const Communicator& ranks) const;

  /// Saves or restores the sums over all ranks. Afterwards they are rank 0's share: the run that
  /// goes on then adds up in the order of one that is continued. Collective.
  void checkpoint(Checkpoint& state, const Communicator& ranks);

 private:
  NodeTotals nodes_;  // of this rank's nodes after the last step
  double initial_ = 0.0;
  double stress_work_ = 0.0;
  double vertical_stress_work_ = 0.0;
  double contact_work_ = 0.0;
  double gravity_work_ = 0.0;
  double slide_loss_ = 0.0;
  double removed_kinetic_ = 0.0;
  double removed_internal_ = 0.0;
  double removed_dissipated_ = 0.0;
};

}  // namespace furrow

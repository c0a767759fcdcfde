// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/loads/restored_forces.h"

#include <utility>

#include "atom.h"
#include "coupling/liggghts/data/contact_history.h"

namespace furrow::coupling {

/// LIGGGHTS would write the contact histories as they were when the neighbour lists were made.
void RestoredForces::store() {
  grain_forces_.store();
  update_contact_histories(lammps_);
}

void RestoredForces::checkpoint(Checkpoint& state, bool in_run, const CoupledSystem& system) {
  std::int64_t next_sort = lammps_.atom->nextsort;
  std::vector<double> contact_forces = system.published_contact_forces();
  state.value("in_run", in_run);
  state.value("next_sort", next_sort);
  state.values("contact_forces", contact_forces);
  if (state.saving()) return;
  waiting_ = in_run;
  next_sort_ = next_sort;
  contact_forces_ = contact_forces;
}

void RestoredForces::suspend_sorting() {
  if (waiting_) sort_interval_ = std::exchange(lammps_.atom->sortfreq, 0);
}

void RestoredForces::keep(const GrainLoads& loads) {
  if (!waiting_) return;
  lammps_.atom->sortfreq = sort_interval_;
  lammps_.atom->nextsort = next_sort_;
  for (const GrainLoad& load : loads.all())
    nodal_forces_.emplace(load.body, load.body->surface().f);
  histories_.save(lammps_);
}

void RestoredForces::put_back(CoupledSystem& system) {
  if (!waiting_) return;
  waiting_ = false;
  grain_forces_.put_back();
  histories_.put_back(lammps_);
  histories_ = {};
  for (auto& [body, forces] : nodal_forces_) body->surface().f = forces;
  nodal_forces_.clear();
  system.restore_published_contact_forces(contact_forces_);
  contact_forces_.clear();
}

}  // namespace furrow::coupling

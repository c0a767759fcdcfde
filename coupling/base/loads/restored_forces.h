// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Forces of the last step before a checkpoint, for the first step of the run that continues it.
///
/// LIGGGHTS computes contact forces with velocities at mid-step. In the set-up of a continued run
/// it knows those of the full step only, and its forces differ by what damping makes of half a
/// step. A checkpoint that is written in the middle of a run therefore brings the forces on grains
/// and nodes and the contact histories; they replace those of the set-up, and the run continues bit
/// for bit. A checkpoint between two runs brings none: the run without a break has a set-up there
/// as well.

#include <cstdint>
#include <map>
#include <vector>

#include "furrow/bodies/coupled_system.h"
#include "furrow/core/checkpoint.h"
#include "coupling/base/loads/grain_forces.h"
#include "coupling/base/loads/grain_loads.h"
#include "coupling/liggghts/data/saved_histories.h"

namespace furrow::coupling {

class RestoredForces {
 public:
  explicit RestoredForces(LAMMPS_NS::LAMMPS& lammps) : lammps_(lammps), grain_forces_(lammps) {}

  /// Makes the storage of the grains' forces, once.
  void make_storage() { grain_forces_.make_storage(); }
  /// Stores what lies with the grains, while a checkpoint is written in the middle of a run.
  void store();
  /// @param in_run  whether the checkpoint is written in the middle of a run
  /// @param system  whose contact forces are saved
  void checkpoint(Checkpoint& state, bool in_run, const CoupledSystem& system);

  /// True while a checkpoint has brought forces that the next step needs.
  bool waiting() const { return waiting_; }
  // Phases of a set-up and of the step after it; nothing happens unless forces are waiting.
  /// Before grains are sorted. The run without a break adds up forces in the order that the
  /// checkpoint has: the set-up must not sort.
  void suspend_sorting();
  /// Before the first forces: keeps the contact histories, which the set-up changes, and the nodal
  /// forces of the bodies, which it clears.
  void keep(const GrainLoads& loads);
  /// Before the step: puts all of them in the place of those of the set-up. The forces on nodes
  /// must be clear.
  void put_back(CoupledSystem& system);

 private:
  LAMMPS_NS::LAMMPS& lammps_;
  GrainForces grain_forces_;
  SavedHistories histories_;
  std::map<Body*, Matrix3X> nodal_forces_;
  std::vector<double> contact_forces_;  // CoupledSystem::published_contact_forces()
  bool waiting_ = false;
  int sort_interval_ = 0;       // [steps], while sorting is suspended
  std::int64_t next_sort_ = 0;  // step, of the checkpoint
};

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix grain/work: where among the grains the work goes that a wheel does on them. See
/// fix_grain_work.md.

#include "coupling/base/furrow_fix.h"
#include "coupling/base/roles/loss_ledger.h"
#include "coupling/base/fix_body.h"
#include "coupling/liggghts/data/pair_contacts.h"

namespace LAMMPS_NS {
class FixPropertyGlobal;
}

namespace furrow::coupling {

class FixGrainWork : public FurrowFix, public LossLedger {
 public:
  FixGrainWork(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static const Outputs<FixGrainWork>& outputs();

  int setmask() override;
  void init() override;
  void end_of_step() override;

  void add_losses(const Body& wheel, GroundLosses& losses) const override;

 protected:
  void checkpoint(Checkpoint& state) override;

 private:
  /// Powers that contacts take [W].
  struct Taken {
    double slide = 0.0, roll = 0.0, press = 0.0;
    double sum() const { return slide + roll + press; }
  };
  /// Track of the wheel: between its sides, and up to the foremost point in the ground.
  struct Track {
    double centre[2], half_width, front;
  };
  using Place = double GrainWork::*;  // below, ahead or aside

  /// Largest tangential over normal force of a contact; infinite where bonds carry more.
  double friction(const PairContact& contact) const;
  Track track() const;
  Place place_of(const PairContact& contact, const Track& track) const;
  /// Power that a contact takes [W].
  Taken power(const PairContact& contact) const;
  // Powers of all grains of this rank [W]: against gravity, by all forces, by those of the wheel.
  double lifting_power() const;
  double power_of_all_forces() const;
  double power_of_wheel() const;
  double kinetic_energy() const;
  double over_ranks(double value) const;

  Body& body_;    // body whose track divides the grains
  double level_;  // [m]
  long every_;
  LAMMPS_NS::FixPropertyGlobal* friction_ = nullptr;  // of pairs of types
  GrainWork work_;  // of this rank; but for `kinetic`, which is found when it is asked for
};

}  // namespace furrow::coupling

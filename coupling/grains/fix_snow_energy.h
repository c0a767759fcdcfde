// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix snow/energy: where the energy of contacts of snow goes, and their bonds. See
/// fix_snow_energy.md.

#include "coupling/base/furrow_fix.h"
#include "furrow/grains/snow_bond.h"

namespace furrow::coupling {

class FixSnowEnergy : public FurrowFix {
 public:
  FixSnowEnergy(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema() { return Schema("fix snow/energy"); }
  static const Outputs<FixSnowEnergy>& outputs();

  int setmask() override;
  void init() override;
  void setup_pre_force(int vflag) override;
  void pre_force(int vflag) override;

  /// A contact in this step. @param share  that belongs to this rank: a half where another rank
  /// computes the contact too, or where the response is that of a contact and its mirror image
  void add(const SnowBondEnergy& energy, bool bonded, double share) {
    present_.stored += share * energy.stored;
    present_.bonds += bonded ? share : 0.0;
    total_.crushed += share * energy.crushed;
    total_.damped += share * energy.damped;
    total_.released += share * energy.released;
  }
  /// A bond in an elastic step.
  void add_elastic(const SnowBondEnergy& energy, double share) {
    present_.stored += share * energy.stored;
    present_.bonds += share;
    total_.damped += share * energy.damped;
  }
  /// The bonds that it made and broke.
  void count(const SnowBondResponse& response, double share) {
    total_.made += response.made ? share : 0.0;
    total_.broken += response.broken ? share : 0.0;
  }
  /// A contact has ended and its springs are lost. @param energy [J]
  void release(double energy, bool bonded, double share);

 protected:
  void checkpoint(Checkpoint& state) override;
  /// With it a continued run begins with the forces of the checkpoint's step, also without a body.
  bool needs_system() const override { return true; }

 private:
  void begin_step();
  double over_ranks(double value) const;

  // Energies of this rank: in the present step, and since the start.
  struct Present {
    double stored = 0.0, bonds = 0.0;
  } present_;
  struct Total {
    double crushed = 0.0, damped = 0.0, released = 0.0, made = 0.0, broken = 0.0;
  } total_;
};

}  // namespace furrow::coupling

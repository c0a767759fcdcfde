// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/grains/fix_snow_energy.h"

#include "furrow/core/communicator.h"
#include "coupling/base/checkpoint_totals.h"
#include "coupling/base/checks/require_unique.h"
#include "coupling/grains/model_snow_bond.h"
#include "coupling/liggghts/styles/style_registry.h"

namespace furrow::coupling {

const StyleRow snow_energy_style =
    fix_style<FixSnowEnergy>("snow/energy", "snow", "grains/fix_snow_energy.md");

const Outputs<FixSnowEnergy>& FixSnowEnergy::outputs() {
  using Fix = FixSnowEnergy;
  static const Outputs<Fix> list = {
      {"stored", "J", "elastic energy of the contacts",
       [](Fix& fix) { return fix.over_ranks(fix.present_.stored); }},
      {"crushed", "J", "plastic work since the start: crushing, slip and yield of bonds",
       [](Fix& fix) { return fix.over_ranks(fix.total_.crushed); }},
      {"damped", "J", "energy dissipated by dampers since the start",
       [](Fix& fix) { return fix.over_ranks(fix.total_.damped); }},
      {"released", "J", "elastic energy lost when bonds broke or were sintered again",
       [](Fix& fix) { return fix.over_ranks(fix.total_.released); }},
      {"bonds", "", "present number of bonds",
       [](Fix& fix) { return fix.over_ranks(fix.present_.bonds); }},
      {"made", "", "bonds formed since the start",
       [](Fix& fix) { return fix.over_ranks(fix.total_.made); }},
      {"broken", "", "bonds broken since the start",
       [](Fix& fix) { return fix.over_ranks(fix.total_.broken); }},
  };
  return list;
}

FixSnowEnergy::FixSnowEnergy(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FurrowFix(lammps, narg, arg, schema()) {
  require_unique<FixSnowEnergy>(*modify, options().subject(), "counts the energy of contacts",
                                "one fix snow/energy", [](FixSnowEnergy&) { return true; });
  provide(outputs());
  keep_state();
}

double FixSnowEnergy::over_ranks(double value) const { return Communicator(&world).sum(value); }

int FixSnowEnergy::setmask() { return LAMMPS_NS::FixConst::PRE_FORCE; }

void FixSnowEnergy::init() {
  collectively([&] { ModelSnowBond::require(*lmp, name(), "whose energy it could count"); });
}

void FixSnowEnergy::setup_pre_force(int) { begin_step(); }
void FixSnowEnergy::pre_force(int) { begin_step(); }
void FixSnowEnergy::begin_step() { present_ = {}; }

void FixSnowEnergy::release(double energy, bool bonded, double share) {
  total_.released += share * energy;
  total_.broken += bonded ? share : 0.0;
}

void FixSnowEnergy::checkpoint(Checkpoint& state) {
  double sums[] = {total_.crushed, total_.damped, total_.released, total_.made, total_.broken};
  checkpoint_totals(state, Communicator(&world), sums);
  if (!state.saving()) total_ = {sums[0], sums[1], sums[2], sums[3], sums[4]};
}

}  // namespace furrow::coupling

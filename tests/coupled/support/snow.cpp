// SPDX-License-Identifier: GPL-2.0-or-later
#include "tests/coupled/support/snow.h"

#include <fmt/format.h>

#include "modify.h"

namespace furrow::test {

void snow_contacts(Scene& scene, const SnowBondParameters& first,
                   const SnowBondParameters& second) {
  const auto property = [&](const char* name, double SnowBondParameters::*value) {
    scene.command(fmt::format("fix {0} all property/global {0} peratomtypepair 2 {1} {1} {1} {2}",
                              name, first.*value, second.*value));
  };
  property("snowModulus", &SnowBondParameters::E);
  property("snowCrushStrength", &SnowBondParameters::Y0);
  property("snowCrushHardening", &SnowBondParameters::p);
  property("snowDenseStrength", &SnowBondParameters::Y1);
  property("snowDenseHardening", &SnowBondParameters::q);
  property("snowBondHardening", &SnowBondParameters::pc);
  property("snowShearStrength", &SnowBondParameters::chi);
  property("snowTensileStrength", &SnowBondParameters::zeta);
  property("snowSintering", &SnowBondParameters::w);
  property("snowDamping", &SnowBondParameters::damping);
  property("coefficientFriction", &SnowBondParameters::mu);
  scene.commands(fmt::format("pair_style gran {}\npair_coeff * *", snow_model));
}

void snow_contacts(Scene& scene, const SnowBondParameters& law) { snow_contacts(scene, law, law); }

void sinter(Scene& scene) { scene.commands("fix sinter all snow/sinter\nrun 1\nunfix sinter"); }

double snow_energy(Scene& scene, int entry) {
  return scene.lammps().modify->find_fix_id("energy")->compute_vector(entry - 1);
}

}  // namespace furrow::test

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Clusters of snow (contact model snow/bond) in a scene.

#include "furrow/grains/snow_bond_parameters.h"
#include "tests/coupled/support/scene.h"

namespace furrow::test {

inline constexpr char snow_model[] = "model snow/bond";

/// Properties of the types 1 and 2; pairs of unlike ones, and walls of type 2 against grains of
/// type 1, have those of type 1. The pair style follows.
void snow_contacts(Scene& scene, const SnowBondParameters& first, const SnowBondParameters& second);
void snow_contacts(Scene& scene, const SnowBondParameters& law);

/// Bonds all clusters that touch, in one step.
void sinter(Scene& scene);

/// Entry of fix snow/energy 'energy', from 1.
double snow_energy(Scene& scene, int entry);

}  // namespace furrow::test

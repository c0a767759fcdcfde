// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The contact model snow/bond of grains: snow that crushes in place. See model_snow_bond.md.

#include <string>

#include "furrow/core/options/options.h"
#include "lammps.h"

namespace furrow::coupling {

struct ModelSnowBond {
  static constexpr const char* name = "snow/bond";
  static Schema schema();
  /// Makes the model known to LIGGGHTS, for pairs of grains and for walls.
  static void add();
  /// For a fix of its contacts. @param lacking  "that it could sinter". @throws InputError
  static void require(const LAMMPS_NS::LAMMPS& lammps, const std::string& where,
                      const std::string& lacking);
};

}  // namespace furrow::coupling

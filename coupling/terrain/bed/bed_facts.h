// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Measured properties of a settled bed of grains.

#include "furrow/core/options/outputs.h"
#include "coupling/terrain/bed/bed_surface.h"
#include "lammps.h"

namespace furrow::coupling {

struct BedFacts {
  double grains = 0.0;
  double solid_fraction = 0.0;
  double bulk_density = 0.0;    ///< [kg/m^3]
  double level = 0.0;           ///< [m]
  double surface_mean = 0.0;    ///< of the grains' tops above the surface [m]
  double surface_rms = 0.0;     ///< of the same [m]
  double kinetic_energy = 0.0;  ///< [J]
  double settle_steps = 0.0;
};

/// Facts of a bed as variables of the script.
const Outputs<const BedFacts>& bed_outputs();

/// Measures the bed in the box. Collective.
/// @param surface at which the bed was levelled
BedFacts measure_bed(LAMMPS_NS::LAMMPS& lammps, const BedSurface& surface);

}  // namespace furrow::coupling

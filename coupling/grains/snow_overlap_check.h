// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Are clusters of snow pressed so far into one another that no snow is left between them? A
/// warning, never an error; of bodies and clusters: coupling/contact/grains/grain_bed_check.h.

#include "atom.h"
#include "lammps.h"
#include "furrow/material/point_block.h"

namespace furrow::coupling {

/// Watches the contacts between clusters. The snow between the centres of two clusters of density
/// rho, pressed along that line alone, has the density rho/(1 - u/d) at the overlap u, d the sum of
/// their radii: ice ends it.
class SnowOverlapCheck {
 public:
  explicit SnowOverlapCheck(LAMMPS_NS::LAMMPS& lammps) : lammps_(lammps) {}

  /// A contact of the grains i and j that yields in this step: no other overlap grows.
  void contact(double overlap, double d, int i, int j) {
    const double* density = lammps_.atom->density;
    const double mean = 0.5 * (density[i] + density[j]);
    if (mean * d > densest_ * (d - overlap)) {
      densest_ = mean * d / (d - overlap);
      largest_ = overlap / d;
    }
  }
  /// After all contacts of a step; compares the ranks every so many steps. Collective.
  void finish_step();

 private:
  LAMMPS_NS::LAMMPS& lammps_;
  double densest_ = ice_density;  // [kg/m^3] between two centres, on this rank
  double largest_ = 0.0;          // overlap there, of d
  bool warned_ = false;
};

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/terrain/bed_facts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "atom.h"
#include "core/communicator.h"
#include "domain.h"
#include "update.h"

namespace furrow::coupling {

namespace {

// Shares of the depth between which the packing is measured: away from the floor and from the
// levelled surface, where it is disturbed over a few grains.
constexpr double slice_bottom = 0.2;
constexpr double slice_top = 0.8;

/// Volume of the part of a sphere below a plane: pi t^2 (r - t/3) with t the plane's height above
/// the lowest point.
double volume_below(double plane, double z, double r) {
  const double t = std::clamp(plane - (z - r), 0.0, 2.0 * r);
  return M_PI * t * t * (r - t / 3.0);
}

/// Area that the bed covers: of the box along a periodic axis, else what the grains span.
double covered_area(LAMMPS_NS::LAMMPS& lammps, const Communicator& ranks) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  const LAMMPS_NS::Domain& domain = *lammps.domain;
  const int periodic[2] = {domain.xperiodic, domain.yperiodic};
  double area = 1.0;
  for (int k = 0; k < 2; ++k) {
    double lower = std::numeric_limits<double>::infinity();
    double upper = -lower;
    for (int i = 0; i < atom.nlocal; ++i) {
      lower = std::min(lower, atom.x[i][k] - atom.radius[i]);
      upper = std::max(upper, atom.x[i][k] + atom.radius[i]);
    }
    lower = -ranks.max(-lower);
    upper = ranks.max(upper);
    area *= periodic[k] ? domain.prd[k] : upper - lower;
  }
  return area;
}

}  // namespace

const Outputs<const BedFacts>& bed_outputs() {
  using F = const BedFacts;
  static const Outputs<F> list = {
      {"bed_grains", "", "number of grains", [](F& facts) { return facts.grains; }},
      {"bed_solid_fraction", "", "solid volume over total volume, from 0.2 to 0.8 of the depth",
       [](F& facts) { return facts.solid_fraction; }},
      {"bed_bulk_density", "kg/m^3", "mass over total volume in the same range",
       [](F& facts) { return facts.bulk_density; }},
      {"bed_level", "m", "z of the surface of a uniform bed with this density and the same mass",
       [](F& facts) { return facts.level; }},
      {"bed_kinetic_energy", "J", "remaining kinetic energy",
       [](F& facts) { return facts.kinetic_energy; }},
      {"bed_settle_steps", "", "steps of the settling; the step counter starts from it",
       [](F& facts) { return facts.settle_steps; }},
  };
  return list;
}

BedFacts measure_bed(LAMMPS_NS::LAMMPS& lammps, double depth) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  const Communicator ranks(&lammps.world);
  const double bottom = lammps.domain->boxlo[2];
  const double low = bottom + slice_bottom * depth;
  const double high = bottom + slice_top * depth;
  // mass, solid volume in the slice, mass in the slice, kinetic energy
  double sums[4] = {0.0, 0.0, 0.0, 0.0};
  for (int i = 0; i < atom.nlocal; ++i) {
    const double z = atom.x[i][2];
    const double r = atom.radius[i];
    const double volume = volume_below(high, z, r) - volume_below(low, z, r);
    sums[0] += atom.rmass[i];
    sums[1] += volume;
    sums[2] += volume * atom.density[i];
    for (int k = 0; k < 3; ++k) sums[3] += 0.5 * atom.rmass[i] * atom.v[i][k] * atom.v[i][k];
  }
  ranks.sum(sums, 4);
  const double area = covered_area(lammps, ranks);

  BedFacts facts;
  facts.grains = static_cast<double>(atom.natoms);
  facts.solid_fraction = sums[1] / (area * (high - low));
  facts.bulk_density = sums[2] / (area * (high - low));
  facts.level = bottom + sums[0] / (area * facts.bulk_density);
  facts.kinetic_energy = sums[3];
  facts.settle_steps = static_cast<double>(lammps.update->ntimestep);
  return facts;
}

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/terrain/bed/bed_facts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "atom.h"
#include "furrow/core/communicator.h"
#include "domain.h"
#include "update.h"

namespace furrow::coupling {

namespace {

// Shares of the least depth between which the packing is measured: away from the floor and from the
// levelled surface, where it is disturbed over a few grains.
constexpr double slice_bottom = 0.2;
constexpr double slice_top = 0.8;

/// Volume of the part of a sphere below a plane: pi t^2 (r - t/3) with t the plane's height above
/// the lowest point.
double volume_below(double plane, double z, double r) {
  const double t = std::clamp(plane - (z - r), 0.0, 2.0 * r);
  return M_PI * t * t * (r - t / 3.0);
}

/// Area of the bed: that of the box along a periodic axis, else the span of the grains.
struct Extent {
  Vector2 lower, upper;  // [m]
  double area() const { return (upper - lower).prod(); }
};

Extent covered(LAMMPS_NS::LAMMPS& lammps, const Communicator& ranks) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  const LAMMPS_NS::Domain& domain = *lammps.domain;
  const int periodic[2] = {domain.xperiodic, domain.yperiodic};
  Extent extent;
  for (int k = 0; k < 2; ++k) {
    double lower = std::numeric_limits<double>::infinity();
    double upper = -lower;
    for (int i = 0; i < atom.nlocal; ++i) {
      lower = std::min(lower, atom.x[i][k] - atom.radius[i]);
      upper = std::max(upper, atom.x[i][k] + atom.radius[i]);
    }
    extent.lower[k] = periodic[k] ? domain.boxlo[k] : -ranks.max(-lower);
    extent.upper[k] = periodic[k] ? domain.boxhi[k] : ranks.max(upper);
  }
  return extent;
}

/// The highest point of a grain on each of a grid of vertical lines, one diameter apart; the floor
/// where a line meets none. Sets mean and rms of their distances from the surface.
void measure_surface(LAMMPS_NS::LAMMPS& lammps, const BedSurface& surface, const Extent& extent,
                     double diameter, BedFacts& facts) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  const auto count = [&](int k) {
    return std::max(1, static_cast<int>((extent.upper[k] - extent.lower[k]) / diameter));
  };
  const int columns = count(0), rows = count(1);
  const Vector2 spacing = (extent.upper - extent.lower).cwiseQuotient(Vector2(columns, rows));
  const auto line = [&](int k, int n) { return extent.lower[k] + (n + 0.5) * spacing[k]; };
  std::vector<double> tops(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
                           lammps.domain->boxlo[2]);
  const auto top = [&](int i, int j) -> double& {
    return tops[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
                static_cast<std::size_t>(i)];
  };
  // lines from `first` to `last` are no farther than a radius from a place
  const auto first = [&](int k, double place) {
    return std::max(0, static_cast<int>(std::ceil((place - extent.lower[k]) / spacing[k] - 0.5)));
  };
  const auto last = [&](int k, double place) {
    return static_cast<int>(std::floor((place - extent.lower[k]) / spacing[k] - 0.5));
  };
  for (int g = 0; g < atom.nlocal; ++g) {
    const double *x = atom.x[g], r = atom.radius[g];
    for (int i = first(0, x[0] - r); i <= std::min(last(0, x[0] + r), columns - 1); ++i)
      for (int j = first(1, x[1] - r); j <= std::min(last(1, x[1] + r), rows - 1); ++j) {
        const double beside = std::hypot(line(0, i) - x[0], line(1, j) - x[1]);
        if (beside < r) top(i, j) = std::max(top(i, j), x[2] + std::sqrt(r * r - beside * beside));
      }
  }
  Communicator(&lammps.world).max(tops.data(), tops.size());
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const double above = top(i, j) - surface.height(line(0, i), line(1, j));
      sum += above;
      squares += above * above;
    }
  facts.surface_mean = sum / static_cast<double>(tops.size());
  facts.surface_rms = std::sqrt(squares / static_cast<double>(tops.size()));
}

}  // namespace

const Outputs<const BedFacts>& bed_outputs() {
  using F = const BedFacts;
  static const Outputs<F> list = {
      {"bed_grains", "", "number of grains", [](F& facts) { return facts.grains; }},
      {"bed_solid_fraction", "",
       "solid volume over total volume, from 0.2 to 0.8 of the least depth",
       [](F& facts) { return facts.solid_fraction; }},
      {"bed_bulk_density", "kg/m^3", "mass over total volume in the same range",
       [](F& facts) { return facts.bulk_density; }},
      {"bed_level", "m", "z of the surface of a uniform bed with this density and the same mass",
       [](F& facts) { return facts.level; }},
      {"bed_surface_mean", "m",
       "mean height of the grains' tops above the surface, on vertical lines one diameter apart",
       [](F& facts) { return facts.surface_mean; }},
      {"bed_surface_rms", "m", "rms of the same height",
       [](F& facts) { return facts.surface_rms; }},
      {"bed_kinetic_energy", "J", "remaining kinetic energy",
       [](F& facts) { return facts.kinetic_energy; }},
      {"bed_settle_steps", "", "steps of the settling; the step counter starts from it",
       [](F& facts) { return facts.settle_steps; }},
  };
  return list;
}

BedFacts measure_bed(LAMMPS_NS::LAMMPS& lammps, const BedSurface& surface) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  const Communicator ranks(&lammps.world);
  const double bottom = lammps.domain->boxlo[2];
  const double low = bottom + slice_bottom * surface.lowest();
  const double high = bottom + slice_top * surface.lowest();
  // mass, solid volume in the slice, mass in the slice, kinetic energy, diameters
  double sums[5] = {0.0, 0.0, 0.0, 0.0, 0.0};
  for (int i = 0; i < atom.nlocal; ++i) {
    const double z = atom.x[i][2];
    const double r = atom.radius[i];
    const double volume = volume_below(high, z, r) - volume_below(low, z, r);
    sums[0] += atom.rmass[i];
    sums[1] += volume;
    sums[2] += volume * atom.density[i];
    for (int k = 0; k < 3; ++k) sums[3] += 0.5 * atom.rmass[i] * atom.v[i][k] * atom.v[i][k];
    sums[4] += 2.0 * r;
  }
  ranks.sum(sums, 5);
  const Extent extent = covered(lammps, ranks);
  const double area = extent.area();

  BedFacts facts;
  facts.grains = static_cast<double>(atom.natoms);
  facts.solid_fraction = sums[1] / (area * (high - low));
  facts.bulk_density = sums[2] / (area * (high - low));
  facts.level = bottom + sums[0] / (area * facts.bulk_density);
  facts.kinetic_energy = sums[3];
  facts.settle_steps = static_cast<double>(lammps.update->ntimestep);
  if (facts.grains > 0) measure_surface(lammps, surface, extent, sums[4] / facts.grains, facts);
  return facts;
}

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/roles/grain_bed.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "atom.h"
#include "atom_vec.h"
#include "furrow/core/communicator.h"
#include "coupling/base/bed_line.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "domain.h"
#include "fix_gravity.h"

namespace furrow::coupling {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
// Difference of a level over the largest diameter of the grains: a bed's level may be that of its
// middles, of its highest grains or a mean, and a few grains may stick out.
constexpr double grain_tolerance = 3.0;

}  // namespace

std::pair<double, double> GrainBed::extent(int direction) const {
  const LAMMPS_NS::Domain& domain = *lammps_.domain;
  const bool periodic[] = {domain.xperiodic != 0, domain.yperiodic != 0, domain.zperiodic != 0};
  if (periodic[direction]) return {-unlimited, unlimited};
  return {domain.boxlo[direction], domain.boxhi[direction]};
}

std::optional<Level> GrainBed::level_under(const Body& body) const {
  const LAMMPS_NS::Atom& atom = *lammps_.atom;
  const auto [lower, upper] = body.surface().bounds();
  double top = -unlimited, largest = 0.0;
  for (int i = 0; i < atom.nlocal; ++i) {
    const double* x = atom.x[i];
    if (x[0] < lower[0] || x[0] > upper[0] || x[1] < lower[1] || x[1] > upper[1]) continue;
    top = std::max(top, x[2] + atom.radius[i]);
    largest = std::max(largest, 2.0 * atom.radius[i]);
  }
  const Communicator ranks(&lammps_.world);
  top = ranks.max(top);
  largest = ranks.max(largest);
  if (top == -unlimited) return std::nullopt;
  return Level{top, grain_tolerance * largest, "the highest grain under it"};
}

std::vector<GivenGravity> GrainBed::gravities() const {
  std::vector<GivenGravity> given;
  for (const auto& [name, value] : bed_line(lammps_))
    if (name == "gravity")
      given.push_back({"command bed, keyword 'gravity'", {0.0, 0.0, -std::stod(value)}});
  for (auto* fix : fixes_of<LAMMPS_NS::FixGravity>(*lammps_.modify)) {
    given.push_back({fmt::format("fix gravity '{}'", fix->id), Vector3::Zero()});
    fix->get_gravity(given.back().vector.data());
  }
  return given;
}

double GrainBed::checkpoint_size() const {
  return Communicator(&lammps_.world)
      .sum(sizeof(double) * static_cast<double>(lammps_.atom->avec->size_restart()));
}

Grounds::Grounds(LAMMPS_NS::LAMMPS& lammps) : bed_(lammps) {
  for (const Ground* terrain : fixes_of<const Terrain>(*lammps.modify)) all_.push_back(terrain);
  if (lammps.atom->natoms > 0) all_.push_back(&bed_);
}

}  // namespace furrow::coupling

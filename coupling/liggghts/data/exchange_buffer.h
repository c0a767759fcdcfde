// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Grains taken out of a run and put in: what LIGGGHTS does itself when a grain changes ranks.
///
/// A packed grain is what AtomVec::pack_exchange writes: the grain's own numbers in the order of
/// AtomVecSphere, then those of every fix that rides with the grains. That order is not public;
/// pack_grain() compares it with the grain.

#include <cstddef>
#include <string>
#include <vector>

#include "lammps.h"

namespace furrow::coupling {

struct PackedGrain {
  std::vector<double> numbers;
  std::vector<std::size_t> parts_at;  ///< index at which the numbers of each rider begin
};

/// Ids of the fixes that ride with the grains, in the order of their parts.
std::vector<std::string> riders(const LAMMPS_NS::LAMMPS& lammps);

// Numbers of a packed grain.
inline const double* packed_position(const double* grain) { return grain + 1; }  ///< [m]
inline double* packed_velocity(double* grain) { return grain + 4; }              ///< [m/s]
inline double packed_radius(const double* grain) { return grain[11]; }           ///< [m]
inline double* packed_angular_velocity(double* grain) { return grain + 14; }     ///< [rad/s]
int packed_tag(const double* grain);
void set_packed_tag(double* grain, int tag);

/// @param grain local index
/// @throws StateError when LIGGGHTS packs in an order that is not AtomVecSphere's
PackedGrain pack_grain(LAMMPS_NS::LAMMPS& lammps, int grain);
/// Adds a packed grain to this rank's.
void add_grain(LAMMPS_NS::LAMMPS& lammps, std::vector<double>& packed);
/// Takes a grain away; the last one gets its local index.
void remove_grain(LAMMPS_NS::LAMMPS& lammps, int grain);
/// Updates numbers and tables after grains were added and removed, in pre_exchange. Collective.
void finish_exchange(LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling

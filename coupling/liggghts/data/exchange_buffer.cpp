// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/data/exchange_buffer.h"

#include <mpi.h>

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "furrow/core/error.h"
#include "coupling/liggghts/data/packed_integer.h"
#include "modify.h"

namespace furrow::coupling {

namespace {

constexpr std::size_t at_tag = 7;
// Room for a grain's own numbers, and for those of each fix beside what it has announced
// (Comm::maxexchange_fix).
constexpr std::size_t own_room = 64, room_for_each_fix = 64;

}  // namespace

int packed_tag(const double* grain) { return unpack_integer(grain[at_tag]); }
void set_packed_tag(double* grain, int tag) { grain[at_tag] = pack_integer(tag); }

std::vector<std::string> riders(const LAMMPS_NS::LAMMPS& lammps) {
  std::vector<std::string> ids;
  for (int e = 0; e < lammps.atom->nextra_grow; ++e)
    ids.emplace_back(lammps.modify->fix[lammps.atom->extra_grow[e]]->id);
  return ids;
}

PackedGrain pack_grain(LAMMPS_NS::LAMMPS& lammps, int i) {
  LAMMPS_NS::Atom& atom = *lammps.atom;
  LAMMPS_NS::Modify& modify = *lammps.modify;
  const std::size_t room = own_room + room_for_each_fix * static_cast<std::size_t>(modify.nfix) +
                           static_cast<std::size_t>(lammps.comm->maxexchange_fix);
  PackedGrain packed;
  packed.numbers.assign(room, 0.0);
  const auto size = static_cast<std::size_t>(atom.avec->pack_exchange(i, packed.numbers.data()));
  if (packed_radius(packed.numbers.data()) != atom.radius[i] ||
      packed_tag(packed.numbers.data()) != atom.tag[i])
    throw StateError(
        "LIGGGHTS packs a grain in an order that is not atom_style granular's; use that style");
  // The fixes' parts come last, in the order of extra_grow.
  std::vector<double> part(room);
  packed.parts_at.resize(static_cast<std::size_t>(atom.nextra_grow));
  std::size_t end = size;
  for (int e = atom.nextra_grow - 1; e >= 0; --e) {
    LAMMPS_NS::Fix* rider = modify.fix[atom.extra_grow[e]];
    end -= static_cast<std::size_t>(rider->pack_exchange(i, part.data()));
    packed.parts_at[static_cast<std::size_t>(e)] = end;
  }
  packed.numbers.resize(size);
  return packed;
}

void add_grain(LAMMPS_NS::LAMMPS& lammps, std::vector<double>& packed) {
  lammps.atom->avec->unpack_exchange(packed.data());
}

void remove_grain(LAMMPS_NS::LAMMPS& lammps, int grain) {
  lammps.atom->avec->copy(lammps.atom->nlocal - 1, grain, 1);
  --lammps.atom->nlocal;
}

void finish_exchange(LAMMPS_NS::LAMMPS& lammps) {
  LAMMPS_NS::Atom& atom = *lammps.atom;
  LAMMPS_NS::bigint local = atom.nlocal;
  MPI_Allreduce(&local, &atom.natoms, 1, MPI_LMP_BIGINT, MPI_SUM, lammps.world);
  atom.nghost = 0;
  if (atom.map_style) {
    atom.map_init();
    atom.map_set();
  }
}

}  // namespace furrow::coupling

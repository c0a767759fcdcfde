// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Results in the memory of rank 0 when another rank fails. Rank 0 then waits in MPI for that rank,
/// and MPI_Abort ends it there; so a thread of it saves them, on a signal of the failing rank.

#include "lammps.h"

namespace furrow::coupling {

/// Saves what fixes have in memory (FlushesOnError). On rank 0. What cannot be saved is lost: the
/// run ends with the error that stopped it, not with this one.
void flush_results(const LAMMPS_NS::LAMMPS& lammps);

/// Once, before MPI_Init(): threads that MPI starts leave the signal alone.
void prepare_rescue();
/// Rank 0 waits for the signal; the others learn where to send it. Collective.
void start_rescue(const LAMMPS_NS::LAMMPS& lammps);
/// On a rank that fails and is not rank 0: has rank 0 save, and gives it time. Only on the computer
/// of rank 0.
void ask_for_rescue();

}  // namespace furrow::coupling

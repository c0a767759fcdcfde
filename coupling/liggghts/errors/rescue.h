// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Saves the results in the memory of rank 0 when another rank fails. Rank 0 then waits in MPI for
/// that rank, and MPI_Abort ends it there. A second thread of rank 0 therefore saves them when the
/// failing rank sends a signal.
///
/// This is best effort. The rows since the last flush are lost when rank 0 runs on another
/// computer, when its main thread is writing results at that moment (HDF5 is not thread-safe), or
/// when saving takes longer than the failing rank waits. The file on disk stays as complete as the
/// last flush left it.

#include <chrono>

#include "lammps.h"

namespace furrow::coupling {

/// The main thread has one of these while it changes results in memory or writes them; the second
/// thread leaves them alone meanwhile. Between runs nothing is left to save. May be nested.
class ResultsInUse {
 public:
  ResultsInUse();
  ~ResultsInUse();
  ResultsInUse(const ResultsInUse&) = delete;
  ResultsInUse& operator=(const ResultsInUse&) = delete;
};

/// Saves the results that fixes have in memory (ResultBuffer). For rank 0. The run ends with the
/// error that stopped it, also when something cannot be saved.
void flush_results(const LAMMPS_NS::LAMMPS& lammps);

/// Flushes results from another thread, when the main thread releases them in time.
/// @return whether it did
bool flush_unused_results(const LAMMPS_NS::LAMMPS& lammps, std::chrono::milliseconds time_limit);

/// Prepares a rescue, once, before MPI_Init(): threads that MPI starts leave the signal alone.
void prepare_rescue();
/// Rank 0 waits for the signal; the others learn where to send it. Collective.
void start_rescue(const LAMMPS_NS::LAMMPS& lammps);
/// Has rank 0 save, and gives it time; called on another rank that fails.
void ask_for_rescue();

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/errors/error_policy.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include <fmt/format.h>
#include <mpi.h>

#include "coupling/liggghts/data/access.h"
#include "coupling/liggghts/errors/error_hints.h"
#include "coupling/liggghts/errors/first_rank.h"
#include "coupling/liggghts/errors/rescue.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/liggghts/errors/signals.h"
#include "output.h"
#include "universe.h"

namespace furrow::coupling {

namespace {

// Time for ranks that meet the same error a little later.
constexpr std::chrono::seconds wait_for_others(5);

bool throws = false;

/// Whole message of an error: the fault, its place in the script, and the place in the source where
/// it was noticed. (The library's message may add a line from a string that no longer exists.)
std::string whole_text(LAMMPS_NS::LAMMPS& lammps, const std::string& text, SourcePlace place) {
  const std::string position = script_position(lammps), hint = hint_for(text);
  std::string whole = text;
  if (!hint.empty()) whole += "\n  " + hint;
  if (!position.empty()) whole += "\n  at " + position;
  if (place.line > 0) whole += fmt::format("\n  (LIGGGHTS, {}:{})", place.file, place.line);
  return whole;
}

/// Reports an error on rank 0, which also saves its results. @return the whole text
std::string report_error(LAMMPS_NS::LAMMPS& lammps, const std::string& text, SourcePlace place) {
  const std::string whole = whole_text(lammps, text, place);
  for (FILE* stream : {lammps.screen, lammps.logfile}) {
    if (!stream) continue;
    std::fprintf(stream, "\nERROR: %s\n", whole.c_str());
    std::fflush(stream);
  }
  flush_results(lammps);
  return whole;
}

/// True if all ranks come here; false when one of them waits for this one elsewhere.
bool all_arrive(MPI_Comm ranks) {
  MPI_Request request;
  MPI_Ibarrier(ranks, &request);
  int done = 0;
  for (const auto start = std::chrono::steady_clock::now();
       !done && std::chrono::steady_clock::now() - start < wait_for_others;
       std::this_thread::sleep_for(std::chrono::milliseconds(1)))
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
  return done != 0;
}

int rank_in(MPI_Comm ranks) {
  int rank = 0;
  MPI_Comm_rank(ranks, &rank);
  return rank;
}

int number_of(MPI_Comm ranks) {
  int size = 1;
  MPI_Comm_size(ranks, &size);
  return size;
}

}  // namespace

void throw_errors() { throws = true; }

void stop_together(LAMMPS_NS::LAMMPS& lammps, const std::string& text, SourcePlace place) {
  if (!all_arrive(lammps.world)) stop_alone(lammps, text, place);
  std::string whole;
  if (rank_in(lammps.world) == 0) whole = report_error(lammps, text, place);
  if (throws) throw RunError{broadcast(whole, lammps.world)};
  delete lammps.output;
  if (lammps.logfile) std::fclose(lammps.logfile);
  if (lammps.universe->nworlds > 1) MPI_Abort(lammps.universe->uworld, failure_status());
  MPI_Finalize();
  std::exit(failure_status());
}

void stop_alone(LAMMPS_NS::LAMMPS& lammps, const std::string& text, SourcePlace place) {
  const int rank = rank_in(lammps.world);
  if (rank == 0) {
    const std::string whole = report_error(lammps, text, place);
    if (throws && number_of(lammps.world) == 1) throw RunError{whole};
  } else {
    std::fprintf(stderr, "\nERROR on rank %d: %s\n", rank, text.c_str());
    const char* line = lammps.input ? current_line(lammps) : nullptr;
    if (line) std::fprintf(stderr, "  at %s\n", line);
    if (place.line > 0) std::fprintf(stderr, "  (LIGGGHTS, %s:%d)\n", place.file, place.line);
    ask_for_rescue();
  }
  MPI_Abort(lammps.world, 1);
  std::abort();  // MPI_Abort does not come back
}

}  // namespace furrow::coupling

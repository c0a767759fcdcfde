// SPDX-License-Identifier: GPL-2.0-or-later
// Functions of libliggghts that this executable stands in front of: the dynamic linker finds ours
// first. They need default visibility, everything else in coupling/ is hidden.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include <dlfcn.h>
#include <mpi.h>

#include "coupling/liggghts/access.h"
#include "coupling/base/flushes_on_error.h"
#include "coupling/styles.h"
#include "error.h"
#include "fix.h"
#include "lammps.h"
#include "modify.h"
#include "output.h"
#include "universe.h"

namespace {

template <class Function>
Function next_definition(const char* symbol) {
  void* address = dlsym(RTLD_NEXT, symbol);
  if (!address) {
    std::fprintf(stderr, "ERROR: libliggghts has no %s; install Debian 12's libliggghts3 3.8.0\n",
                 symbol);
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  return reinterpret_cast<Function>(address);
}

/// One error, one message: what is wrong, where in the script, and where in the source it was
/// noticed. (The library's own version may add a line from a string that no longer exists.)
void print_error(LAMMPS_NS::LAMMPS& lammps, const std::string& text, const char* file, int line) {
  const std::string position = furrow::coupling::script_position(lammps);
  for (FILE* stream : {lammps.screen, lammps.logfile}) {
    if (!stream) continue;
    std::fprintf(stream, "\nERROR: %s\n", text.c_str());
    if (!position.empty()) std::fprintf(stream, "  at %s\n", position.c_str());
    if (line > 0) std::fprintf(stream, "  (LIGGGHTS, %s:%d)\n", file, line);
    std::fflush(stream);
  }
}

/// Whatever cannot be saved now is lost: the run ends with the error that stopped it, not with this
/// one.
void flush_results(const LAMMPS_NS::LAMMPS& lammps) {
  for (int i = 0; lammps.modify && i < lammps.modify->nfix; ++i) try {
      if (auto* keeper = dynamic_cast<furrow::coupling::FlushesOnError*>(lammps.modify->fix[i]))
        keeper->flush_results();
    } catch (const std::exception& loss) {
      std::fprintf(stderr, "Results of fix %s are lost: %s\n", lammps.modify->fix[i]->id,
                   loss.what());
    }
}

// for ranks that come to the same error a little later
constexpr std::chrono::seconds patience(10);

/// Whether all ranks come here; false when one of them waits for this one elsewhere.
bool all_arrive(MPI_Comm ranks) {
  MPI_Request request;
  MPI_Ibarrier(ranks, &request);
  int done = 0;
  for (const auto start = std::chrono::steady_clock::now();
       !done && std::chrono::steady_clock::now() - start < patience;
       std::this_thread::sleep_for(std::chrono::milliseconds(1)))
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
  return done != 0;
}

/// All ranks have come to the same error: leave together, dumps and logs closed. What was thought
/// to befall all may befall one (a particle of its part of the ground): then as Error::one.
[[noreturn]] void stop_together(LAMMPS_NS::LAMMPS& lammps, const std::string& text,
                                const char* file, int line) {
  if (!all_arrive(lammps.world)) {
    lammps.error->one(file, line, text.c_str());
    std::abort();  // one() does not come back
  }
  int rank = 0;
  MPI_Comm_rank(lammps.world, &rank);
  if (rank == 0) {
    print_error(lammps, text, file, line);
    flush_results(lammps);
  }
  delete lammps.output;
  if (lammps.logfile) std::fclose(lammps.logfile);
  if (lammps.universe->nworlds > 1) MPI_Abort(lammps.universe->uworld, 1);
  MPI_Finalize();
  std::exit(1);
}

std::string fix_text(const LAMMPS_NS::Fix& fix, const char* style, const char* text) {
  const std::string name = std::string("fix ") + style + " (id " + fix.id + "): ";
  return name + (std::string(text).size() > 2 ? text : "illegal command");
}

}  // namespace

namespace LAMMPS_NS {

#define FURROW_EXPORTED __attribute__((visibility("default")))

/// Called at the start and by the command clear, both of which make a new table of fix styles.
FURROW_EXPORTED void LAMMPS::create() {
  next_definition<void (*)(LAMMPS*)>("_ZN9LAMMPS_NS6LAMMPS6createEv")(this);
  furrow::coupling::add_styles(*this);
}

FURROW_EXPORTED void Error::all(const char* file, int line, const char* text) {
  stop_together(*lmp, text, file, line);
}

FURROW_EXPORTED void Error::fix_error(const char* file, int line, Fix* fix, const char* text) {
  stop_together(*lmp, fix_text(*fix, fix->style, text), file, line);
}

FURROW_EXPORTED void Error::fix_error(const char* file, int line, Fix* fix, const char* style,
                                      const char* text) {
  stop_together(*lmp, fix_text(*fix, style, text), file, line);
}

/// One rank alone: the others cannot be told, so the run is aborted.
FURROW_EXPORTED void Error::one(const char* file, int line, const char* text) {
  int rank = 0;
  MPI_Comm_rank(world, &rank);
  if (rank == 0) {
    print_error(*lmp, text, file, line);
    flush_results(*lmp);
  } else {
    std::fprintf(stderr, "\nERROR on rank %d: %s\n", rank, text);
    if (line > 0) std::fprintf(stderr, "  (LIGGGHTS, %s:%d)\n", file, line);
  }
  MPI_Abort(world, 1);
}

}  // namespace LAMMPS_NS

// Functions of libliggghts that this executable stands in front of. The dynamic linker finds ours first; each does its own small
// part and calls the library's. They need default visibility, everything else in coupling/ is hidden.

#include <cstdio>
#include <string>

#include <dlfcn.h>
#include <mpi.h>

#include "coupling/liggghts_access.h"
#include "coupling/styles.h"
#include "error.h"
#include "lammps.h"

namespace {

template <class Function>
Function next_definition(const char* symbol) {
  void* address = dlsym(RTLD_NEXT, symbol);
  if (!address) {
    std::fprintf(stderr, "ERROR: libliggghts has no %s; install Debian 12's libliggghts3 3.8.0\n", symbol);
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  return reinterpret_cast<Function>(address);
}

/// LIGGGHTS says where in its own source an error arose; the user wants to know where in the script.
void print_script_position(LAMMPS_NS::LAMMPS& lammps, bool every_rank) {
  int rank = 0;
  MPI_Comm_rank(lammps.world, &rank);
  if (rank != 0) {
    if (every_rank) std::fprintf(stderr, "ERROR on rank %d:\n", rank);
    return;
  }
  const std::string position = furrow::coupling::script_position(lammps);
  if (position.empty()) return;
  for (FILE* stream : {lammps.screen, lammps.logfile})
    if (stream) std::fprintf(stream, "\nERROR at %s\n", position.c_str());
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
  print_script_position(*lmp, false);
  next_definition<void (*)(Error*, const char*, int, const char*)>("_ZN9LAMMPS_NS5Error3allEPKciS2_")(this, file, line, text);
}

FURROW_EXPORTED void Error::one(const char* file, int line, const char* text) {
  print_script_position(*lmp, true);
  next_definition<void (*)(Error*, const char*, int, const char*)>("_ZN9LAMMPS_NS5Error3oneEPKciS2_")(this, file, line, text);
}

FURROW_EXPORTED void Error::fix_error(const char* file, int line, Fix* fix, const char* text) {
  print_script_position(*lmp, false);
  next_definition<void (*)(Error*, const char*, int, Fix*, const char*)>("_ZN9LAMMPS_NS5Error9fix_errorEPKciPNS_3FixES2_")(
      this, file, line, fix, text);
}

FURROW_EXPORTED void Error::fix_error(const char* file, int line, Fix* fix, const char* style, const char* text) {
  print_script_position(*lmp, false);
  next_definition<void (*)(Error*, const char*, int, Fix*, const char*, const char*)>(
      "_ZN9LAMMPS_NS5Error9fix_errorEPKciPNS_3FixES2_S2_")(this, file, line, fix, style, text);
}

}  // namespace LAMMPS_NS

// SPDX-License-Identifier: GPL-2.0-or-later
// Functions of libliggghts that this executable stands in front of: the dynamic linker finds ours
// first. They need default visibility, everything else in coupling/ is hidden.

#include <cstdio>
#include <string>

#include <mpi.h>

#include "coupling/liggghts/error_policy.h"
#include "coupling/liggghts/library_check.h"
#include "coupling/styles.h"
#include "error.h"
#include "fix.h"
#include "lammps.h"

namespace {

using furrow::coupling::stop_alone;
using furrow::coupling::stop_together;

std::string fix_text(const LAMMPS_NS::Fix& fix, const char* style, const char* text) {
  const std::string name = std::string("fix ") + style + " (id " + fix.id + "): ";
  return name + (std::string(text).size() > 2 ? text : "illegal command");
}

}  // namespace

namespace LAMMPS_NS {

#define FURROW_EXPORTED __attribute__((visibility("default")))

/// Called at the start and by the command clear, both of which make a new table of fix styles.
FURROW_EXPORTED void LAMMPS::create() {
  using furrow::coupling::create_symbol;
  void* original = furrow::coupling::next_definition(create_symbol);
  if (!original) {  // without it there is no instance that check_library() could look at
    std::fprintf(stderr,
                 "ERROR: the LIGGGHTS library has no %s; install libliggghts3 %s of Debian 12\n",
                 create_symbol, furrow::coupling::liggghts_version);
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  reinterpret_cast<void (*)(LAMMPS*)>(original)(this);
  furrow::coupling::add_styles(*this);
}

FURROW_EXPORTED void Error::all(const char* file, int line, const char* text) {
  stop_together(*lmp, text, {file, line});
}

FURROW_EXPORTED void Error::fix_error(const char* file, int line, Fix* fix, const char* text) {
  stop_together(*lmp, fix_text(*fix, fix->style, text), {file, line});
}

FURROW_EXPORTED void Error::fix_error(const char* file, int line, Fix* fix, const char* style,
                                      const char* text) {
  stop_together(*lmp, fix_text(*fix, style, text), {file, line});
}

FURROW_EXPORTED void Error::one(const char* file, int line, const char* text) {
  stop_alone(*lmp, text, {file, line});
}

}  // namespace LAMMPS_NS

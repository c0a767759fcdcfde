// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/errors/stream_check.h"

#include <cstdio>
#include <string>

#include <fmt/format.h>
#include <sys/stat.h>

#include "furrow/core/communicator.h"
#include "furrow/core/error.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/liggghts/data/access.h"
#include "coupling/liggghts/errors/checked_stream.h"
#include "coupling/liggghts/errors/first_rank.h"

namespace furrow::coupling {

namespace {

/// @param name for the error
void check(FILE* stream, const std::string& name) {
  if (!stream || (std::fflush(stream) == 0 && !std::ferror(stream))) return;
  struct stat status = {};
  if (fstat(fileno(stream), &status) == 0 && (S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode)))
    return;
  throw StateError(
      fmt::format("{} could not be written in full: the disk is full, or broken; make room, and "
                  "repeat the run",
                  name));
}

/// Reports a fault of the screen on stderr, because the screen may take nothing.
void check_screen(FILE* screen) try {
  check(screen, "what goes to the screen");
} catch (const StateError& problem) {
  std::fprintf(stderr, "ERROR: %s\n", problem.what());
  throw;
}

}  // namespace

void check_streams(const LAMMPS_NS::LAMMPS& lammps) {
  on_first_rank(lammps.world, [&] {
    check_screen(lammps.screen);
    check(lammps.logfile, "the log");
    for (auto* fix : fixes_of<LAMMPS_NS::FixAveTime>(*lammps.modify))
      check(file_of(*fix), fmt::format("the file of fix ave/time '{}'", fix->id));
  });
  const std::string failure = take_stream_failure();
  const Communicator ranks(&lammps.world);
  if (ranks.max(failure.empty() ? 0.0 : 1.0) == 0.0) return;
  throw StateError(fmt::format("{}; it was not written in full: make room, and repeat the run",
                               failure.empty() ? "a dump of another rank" : failure));
}

}  // namespace furrow::coupling

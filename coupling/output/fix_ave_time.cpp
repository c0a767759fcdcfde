// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/output/fix_ave_time.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "comm.h"
#include "coupling/base/restart_record.h"
#include "coupling/liggghts/data/access.h"
#include "coupling/liggghts/data/averages.h"
#include "coupling/liggghts/checkpoint_file.h"
#include "coupling/liggghts/errors/errors.h"
#include "coupling/liggghts/styles/script.h"
#include "modify.h"
#include "update.h"

namespace furrow::coupling {

const StyleRow ave_time_style = fix_style<FixAveTime>("ave/time", "internal", "");

FixAveTime::FixAveTime(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixAveTime(lammps, narg, arg, earlier_file(*lammps, narg, arg)) {}

/// LIGGGHTS's constructor empties the file.
FixAveTime::FixAveTime(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, EarlierFile earlier)
    : LAMMPS_NS::FixAveTime(lammps, narg, arg), earlier_(std::move(earlier)) {
  restart_global = 1;
}

FixAveTime::EarlierFile FixAveTime::earlier_file(const LAMMPS_NS::LAMMPS& lammps, int narg,
                                                 char** arg) {
  if (lammps.comm->me != 0 || checkpoint_read().empty()) return {};
  EarlierFile earlier;
  for (int n = 3; n + 1 < narg; ++n)
    if (std::strcmp(arg[n], "file") == 0) earlier.path = arg[n + 1];
  std::ifstream file(earlier.path, std::ios::binary);
  earlier.text.assign(std::istreambuf_iterator<char>(file), {});
  return earlier;
}

/// The checkpoint is written after the row of its step.
std::string FixAveTime::rows_until_now() const {
  std::istringstream lines(earlier_.text);
  std::string rows;
  for (std::string line; std::getline(lines, line) && !lines.eof();) {
    if (line.empty() || line[0] == '#') continue;
    char* end = nullptr;
    if (std::strtoll(line.c_str(), &end, 10) > update->ntimestep) break;
    rows += line + '\n';
    if (!writes_blocks(*this)) continue;
    for (long left = std::strtol(end, nullptr, 10); left > 0 && std::getline(lines, line); --left)
      rows += line + '\n';
  }
  return rows;
}

void FixAveTime::init() {
  LAMMPS_NS::FixAveTime::init();
  const std::string text = std::exchange(earlier_.text, {});
  if (restored_ || text.empty()) return;
  warn(*lmp, fmt::format("fix ave/time '{}' has no state in the checkpoint: its file '{}' begins "
                         "again, without the rows of the first run",
                         id, earlier_.path));
}

void FixAveTime::write_restart(FILE* file) {
  if (comm->me != 0) return;
  with_local_errors(*error, [&] {
    Checkpoint state(fmt::format("fix ave/time '{}'", id));
    checkpoint_averages(state, *this);
    write_record(file, state);
  });
}

void FixAveTime::restart(char* buffer) {
  with_collective_errors(*error, [&] {
    Checkpoint state = read_record(fmt::format("fix ave/time '{}'", id), buffer);
    checkpoint_averages(state, *this);
    state.finish();
  });
  modify->addstep_compute_all(next_step(*this));
  restored_ = true;
  FILE* file = file_of(*this);
  if (!file) return;
  if (earlier_.text.empty())
    warn(*lmp, fmt::format("fix ave/time '{}': its file '{}' of the first run is not there, or has "
                           "no rows; it begins with the continued run",
                           id, earlier_.path));
  std::fputs(rows_until_now().c_str(), file);
  std::fflush(file);
}

}  // namespace furrow::coupling

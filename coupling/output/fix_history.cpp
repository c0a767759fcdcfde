// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/output/fix_history.h"

#include "comm.h"
#include "coupling/bodies/fix_coupled_system.h"
#include "coupling/liggghts/errors.h"
#include "coupling/liggghts/access.h"
#include "coupling/base/restart_record.h"
#include "coupling/base/args.h"
#include "update.h"

namespace furrow::coupling {

void FixHistory::add_keys(Schema& schema, const char* frames) {
  schema.text("folder",
              "folder for the results; made if need be, earlier results in it are replaced");
  schema.integer("every", Range::at_least(1), "steps between rows of the history");
  schema
      .integer("vtk", Range::at_least(0),
               fmt::format("steps between frames of {}; 0: none", frames))
      .by_default("0");
}

FixHistory::FixHistory(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Schema& schema)
    : Fix(lammps, narg, arg), options_(schema.read(words_after_style(narg, arg))) {
  nevery = 1;
  restart_global = 1;
}

int FixHistory::setmask() {
  return LAMMPS_NS::FixConst::END_OF_STEP | LAMMPS_NS::FixConst::POST_RUN;
}

double FixHistory::time() const { return FixWorld::of(*lmp).time(); }

double FixHistory::wall_time() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

RunInfo FixHistory::run_info(const std::string& title) const {
  RunInfo info;
  info.title = title;
  info.script = script_name(*lmp);
  info.effective_input = effective_input(*lmp);
  info.ranks = comm->nprocs;
  return info;
}

// Rank 0 alone writes, so it may fail alone.

void FixHistory::setup(int) {
  guarded_alone(*error, [&] {
    if (opened_) return;
    opened_ = true;
    started_ = std::chrono::steady_clock::now();
    open(resume_time_);
    if (resume_time_) return;
    record();
    if (draws()) write_frame();
  });
}

void FixHistory::end_of_step() {
  guarded_alone(*error, [&] {
    if (update->ntimestep % options_.integer("every") == 0) record();
    if (draws() && update->ntimestep % options_.integer("vtk") == 0) write_frame();
  });
}

void FixHistory::post_run() {
  guarded_alone(*error, [&] { close(); });
}

void FixHistory::keep_results() {
  if (file_) file_->flush();
}

/// A checkpoint: the rows up to it must be in the file, or a continued run would find a gap.
void FixHistory::write_restart(FILE* checkpoint) {
  if (comm->me != 0) return;
  guarded_alone(*error, [&] { keep_results(); });
  write_record(checkpoint, {time()});
}

void FixHistory::restart(char* buffer) { resume_time_ = *reinterpret_cast<const double*>(buffer); }

}  // namespace furrow::coupling

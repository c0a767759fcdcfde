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
    : Fix(lammps, narg, arg), options_(schema.read(args_after_style(narg, arg))) {
  nevery = 1;
  restart_global = 1;
}

int FixHistory::setmask() {
  return LAMMPS_NS::FixConst::END_OF_STEP | LAMMPS_NS::FixConst::POST_RUN;
}

double FixHistory::time() const { return FixCoupledSystem::of(*lmp).time(); }

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
  with_local_errors(*error, [&] {
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
  with_local_errors(*error, [&] {
    if (update->ntimestep % options_.integer("every") == 0) record();
    if (draws() && update->ntimestep % options_.integer("vtk") == 0) write_frame();
  });
}

void FixHistory::post_run() {
  with_local_errors(*error, [&] { close(); });
}

void FixHistory::flush_results() {
  if (file_) file_->flush();
}

/// A checkpoint: the rows up to it must be in the file, or a continued run would find a gap.
void FixHistory::write_restart(FILE* checkpoint) {
  if (comm->me != 0) return;
  with_local_errors(*error, [&] {
    flush_results();
    Checkpoint state(style);
    double now = time();
    state.value("time", now);
    write_record(checkpoint, state);
  });
}

void FixHistory::restart(char* buffer) {
  with_collective_errors(*error, [&] {
    Checkpoint state = read_record(style, buffer);
    double saved = 0.0;
    state.value("time", saved);
    state.finish();
    resume_time_ = saved;
  });
}

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/output/fix_history.h"

#include <fmt/format.h>

#include "comm.h"
#include "coupling/base/fix_coupled_system.h"
#include "coupling/liggghts/script.h"
#include "coupling/output/style_records.h"
#include "update.h"

namespace furrow::coupling {

void FixHistory::add_keys(Schema& schema, const char* frames) {
  schema.text("folder",
              "folder for the results; made if it is missing, earlier results in it are replaced");
  schema.integer("every", Range::at_least(1), "steps between rows of the history");
  schema
      .integer("vtk", Range::at_least(0),
               fmt::format("steps between frames of {}; 0: none", frames))
      .by_default("0");
}

FixHistory::FixHistory(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Schema& schema)
    : FurrowFix(lammps, narg, arg, schema) {
  nevery = 1;
  keep_state();
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
  info.styles = style_records(*lmp);
  info.ranks = comm->nprocs;
  return info;
}

// Rank 0 alone writes, so it may fail alone.

void FixHistory::setup(int) {
  on_this_rank([&] {
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
  on_this_rank([&] {
    if (update->ntimestep % options().integer("every") == 0) record();
    if (draws() && update->ntimestep % options().integer("vtk") == 0) write_frame();
  });
}

void FixHistory::post_run() {
  on_this_rank([&] { close(); });
}

void FixHistory::flush_results() {
  if (file_) file_->flush();
}

void FixHistory::checkpoint(Checkpoint& state) {
  if (state.saving()) on_this_rank([&] { flush_results(); });
  double now = state.saving() ? time() : 0.0;
  state.value("time", now);
  if (!state.saving()) resume_time_ = now;
}

}  // namespace furrow::coupling

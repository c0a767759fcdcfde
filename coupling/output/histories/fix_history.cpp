// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/output/histories/fix_history.h"

#include <filesystem>

#include <fmt/format.h>

#include "comm.h"
#include "furrow/core/error.h"
#include "coupling/base/checks/require_unique.h"
#include "coupling/base/fix_coupled_system.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/liggghts/errors/rescue.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/output/results_folder.h"
#include "coupling/output/style_records.h"
#include "update.h"

namespace furrow::coupling {

void FixHistory::add_keys(Schema& schema, const char* frames) {
  schema.text("folder",
              "folder of the results; created if missing; earlier results in it are replaced");
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

void FixHistory::take_file(const std::string& name) {
  file_name_ = name;
  const auto folder = [](const FixHistory& fix) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(fix.in_folder(".")));
  };
  require_unique<FixHistory>(
      *modify, options().where("folder"),
      fmt::format("is '{}', which this fix writes its files to", options().text("folder")),
      "a folder for each wheel/history, and for each terrain/history", [&](FixHistory& other) {
        return other.file_name_ == name && folder(other) == folder(*this);
      });
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

void FixHistory::open_rows(const std::vector<Channel>& channels, const std::string& title,
                           std::optional<double> resume_time) {
  const std::string path = in_folder(file_name_);
  file_ = resume_time ? HistoryFile::resume(path, channels, *resume_time)
                      : HistoryFile::create(path, channels, run_info(title));
}

std::optional<VtkSeries> FixHistory::open_frames(const std::string& series,
                                                 std::optional<double> resume_time) const {
  if (!draws()) return {};
  const std::string folder = in_folder("vtk");
  return resume_time ? VtkSeries::resume(folder, series, *resume_time)
                     : VtkSeries::create(folder, series);
}

/// A script of many short runs may mean it.
void FixHistory::warn_of_long_intervals() {
  const long steps = update->nsteps;
  for (const char* key : {"every", "vtk"}) {
    const long interval = options().integer(key);
    if (steps == 0 || interval <= steps || warned_) continue;
    warned_ = true;
    warn(*lmp, fmt::format("{} is {} steps, and this run has {}: nothing is written after its "
                           "start; write a smaller number",
                           options().where(key), interval, steps));
  }
}

// Rank 0 alone writes, so it may fail alone.

/// Takes the folder and its lock; a terrain/history shares those of its wheel/history.
void FixHistory::take_folder() {
  if (comm->me != 0) return;
  if (!resume_time_) make_results_folder(options());
  std::error_code absent;  // the folder of a run that continues: open() reports a missing one
  for (FixHistory* other : fixes_of<FixHistory>(*modify))
    if (other->lock_ && std::filesystem::equivalent(other->in_folder("."), in_folder("."), absent))
      lock_ = other->lock_;
  if (!lock_) lock_ = std::make_shared<FolderLock>(options().text("folder"));
  if (lock_->held_by_another())
    throw InputError(
        options().where("folder"),
        fmt::format("is '{}', which another run is writing to", options().text("folder")),
        "a folder for each run", "wait until that run has ended, or name another folder");
}

void FixHistory::setup(int) {
  on_this_rank([&] {
    warn_of_long_intervals();
    if (opened_) return;
    opened_ = true;
    take_folder();
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
  if (!file_) return;
  const ResultsInUse in_use;
  file_->flush();
}

void FixHistory::release_folder() {
  file_.reset();
  lock_.reset();
}

void FixHistory::checkpoint(Checkpoint& state) {
  if (state.saving()) on_this_rank([&] { flush_results(); });
  double now = state.saving() ? time() : 0.0;
  state.value("time", now);
  if (!state.saving()) resume_time_ = now;
}

}  // namespace furrow::coupling

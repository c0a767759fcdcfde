#include "coupling/fix_wheel_history.h"

#include <cmath>

#include <fmt/format.h>

#include "atom.h"
#include "comm.h"
#include "core/error.h"
#include "coupling/fix_wheel_rig.h"
#include "coupling/fix_wheel_hub.h"
#include "coupling/gather_grains.h"
#include "coupling/guard.h"
#include "coupling/liggghts_access.h"
#include "coupling/restart_record.h"
#include "coupling/results_folder.h"
#include "coupling/words.h"
#include "io/summary.h"
#include "modify.h"
#include "update.h"

namespace furrow::coupling {

namespace {

FixWheelRig& find_rig(LAMMPS_NS::LAMMPS& lammps, const Options& options) {
  auto* rig = dynamic_cast<FixWheelRig*>(lammps.modify->find_fix_id(options.word("rig").c_str()));
  if (!rig)
    throw InputError(options.where("rig"), fmt::format("is '{}', and there is no such rig", options.word("rig")),
                     "the id of a fix wheel/rig", "write the fix wheel/rig before this line");
  return *rig;
}

}  // namespace

Schema FixWheelHistory::schema() {
  Schema schema("fix wheel/history");
  schema.text("rig", "id of the fix wheel/rig whose wheel is recorded");
  schema.text("folder", "folder for the results; made if need be, earlier results in it are replaced");
  schema.integer("every", Range::at_least(1), "steps between rows of the history");
  schema.integer("vtk", Range::at_least(0), "steps between frames of wheel and grains; 0: none").by_default("0");
  schema.text("title", "what the scene is, for summaries and pictures").by_default("wheel");
  return schema;
}

FixWheelHistory::FixWheelHistory(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg),
      options_(schema().read(words_after_style(narg, arg))),
      rig_fix_(find_rig(*lammps, options_)),
      folder_(options_.word("folder")),
      every_(options_.integer("every")),
      vtk_every_(options_.integer("vtk")) {
  nevery = 1;
  restart_global = 1;
}

int FixWheelHistory::setmask() { return LAMMPS_NS::FixConst::END_OF_STEP | LAMMPS_NS::FixConst::POST_RUN; }

bool FixWheelHistory::needs(LAMMPS_NS::Fix& other) const { return &other == &rig_fix_; }

FixWorld& FixWheelHistory::bodies() { return FixWorld::of(*lmp); }

/// Files are made when the first run starts: by then every style of the scene is known. Rank 0 alone writes, so it may fail alone.
void FixWheelHistory::setup(int) {
  guarded_alone(*error, [&] {
    if (opened_) return;
    opened_ = true;
    open();
    started_ = std::chrono::steady_clock::now();
    first_step_ = update->ntimestep;
    first_time_ = bodies().time();
    first_energy_ = rig_fix_.wheel_fix().hub().balance().residual();
    if (!resume_time_) {
      record();
      if (vtk_every_ > 0) write_frame();
    }
  });
}

void FixWheelHistory::open() {
  const double ground_level = rig_fix_.options().number("ground_level");
  Grains now = gather_grains(*lmp, ground_level);
  if (comm->me != 0) return;
  const std::string path = folder_ + "/history.h5", frames = folder_ + "/vtk";
  if (resume_time_) {
    file_ = HistoryFile::resume(path, WheelRig::channels(), *resume_time_);
    if (now.size() > 0)
      reference_ = read_reference_grains(path);
    else
      reference_ = std::move(now);
    if (vtk_every_ > 0) {
      wheel_frames_ = VtkSeries::resume(frames, "wheel", *resume_time_);
      grain_frames_ = VtkSeries::resume(frames, "grains", *resume_time_);
    }
    return;
  }
  make_results_folder(options_);
  RunInfo info;
  info.title = options_.word("title");
  info.script = script_name(*lmp);
  info.effective_input = effective_input(*lmp);
  info.ranks = comm->nprocs;
  file_ = HistoryFile::create(path, WheelRig::channels(), info);
  reference_ = std::move(now);
  if (reference_.size() > 0) file_->write_reference(reference_);
  if (vtk_every_ > 0) {
    wheel_frames_ = VtkSeries::create(frames, "wheel");
    grain_frames_ = VtkSeries::create(frames, "grains");
  }
}

/// An error ends the run: the rows since the last flush are still worth having.
void FixWheelHistory::keep_results() {
  if (file_) file_->flush();
}

void FixWheelHistory::end_of_step() {
  guarded_alone(*error, [&] {
    if (update->ntimestep % every_ == 0) record();
    if (vtk_every_ > 0 && update->ntimestep % vtk_every_ == 0) write_frame();
  });
}

void FixWheelHistory::record() {
  if (file_) file_->append(rig_fix_.rig().measure(bodies().time()));
}

void FixWheelHistory::write_frame() {
  const Grains grains = gather_grains(*lmp, reference_.bed_level);
  if (comm->me != 0) return;
  wheel_frames_->add(bodies().time(), rig_fix_.wheel_fix().hub().surface());
  if (grains.size() > 0) grain_frames_->add(bodies().time(), grains, &reference_);
}

/// Also reached when the user interrupts the run: what there is, is written and evaluated.
void FixWheelHistory::post_run() {
  guarded_alone(*error, [&] {
    const RunClosing end = closing();
    const Grains grains = gather_grains(*lmp, reference_.bed_level);
    if (comm->me != 0) return;
    file_->write_final(grains, rig_fix_.wheel_fix().hub().surface());
    file_->write_closing(end);
    file_->flush();
    const Summary summary = summarise(folder_);
    write_summary(folder_, summary);
    if (screen) fmt::print(screen, "\n{}\n", summary_text(summary));
  });
}

RunClosing FixWheelHistory::closing() {
  const WheelHub& wheel = rig_fix_.wheel_fix().hub();
  const Balance balance = wheel.balance();
  const MomentumAudit& momentum = bodies().audit(wheel);
  RunClosing end;
  end.audit.energies = {{"work of the ground on the wheel", balance.contact_work},
                        {"work of the load", balance.load_work},
                        {"work of the drive", balance.drive_work},
                        {"kinetic energy of the wheel", -balance.kinetic_energy},
                        {"stored in the wheel", -balance.stored_energy},
                        {"loss in the wheel and the rig's damping", -balance.dissipated_energy}};
  end.audit.energy_residual = balance.residual() - first_energy_;
  for (const EnergyTerm& term : end.audit.energies)
    end.audit.energy_scale = std::max(end.audit.energy_scale, std::abs(term.value));
  end.audit.force_imbalance = momentum.force_imbalance;
  end.audit.force_scale = momentum.force_scale;
  end.audit.moment_imbalance = momentum.moment_imbalance;
  end.audit.moment_scale = momentum.moment_scale;
  end.cost.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  end.cost.simulated_time = bodies().time() - first_time_;
  end.cost.steps = static_cast<long>(update->ntimestep) - first_step_;
  end.cost.grains = static_cast<long>(atom->natoms);
  end.cost.ranks = comm->nprocs;
  end.cost.memory = bodies().communicator().sum(peak_memory());
  if (update->ntimestep < update->laststep)
    end.warnings.push_back(
        fmt::format("The run was interrupted at step {} of {}; the values are those of the part that was done.",
                    update->ntimestep, update->laststep));
  return end;
}

/// A checkpoint: the rows up to it must be in the file, or a continued run would find a gap.
void FixWheelHistory::write_restart(FILE* checkpoint) {
  if (comm->me != 0) return;
  guarded_alone(*error, [&] {
    if (file_) file_->flush();
  });
  write_record(checkpoint, {bodies().time()});
}

void FixWheelHistory::restart(char* buffer) { resume_time_ = *reinterpret_cast<const double*>(buffer); }

}  // namespace furrow::coupling

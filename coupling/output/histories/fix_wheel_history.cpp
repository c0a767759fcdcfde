// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/output/histories/fix_wheel_history.h"

#include <fmt/format.h>

#include "atom.h"
#include "comm.h"
#include "coupling/base/roles/loss_ledger.h"
#include "coupling/base/fix_coupled_system.h"
#include "coupling/base/roles/fix_rig.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/liggghts/errors/rescue.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "coupling/output/gather_grains.h"
#include "coupling/output/grain_virial.h"
#include "furrow/io/results/summary.h"
#include "update.h"

namespace furrow::coupling {

const StyleRow wheel_history_style =
    fix_style<FixWheelHistory>("wheel/history", "history", "output/histories/fix_wheel_history.md");

Schema FixWheelHistory::schema() {
  Schema schema("fix wheel/history");
  schema.text("rig", "id of the fix of the rig whose wheel is recorded");
  add_keys(schema, "wheel and grains");
  schema.text("title", "name of the scene in summaries and pictures; one word").by_default("wheel");
  return schema;
}

FixWheelHistory::FixWheelHistory(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixHistory(lammps, narg, arg, schema()), rig_fix_(use<FixRig>("rig", {"rig"})) {
  take_file("history.h5");
}

OutputTable FixWheelHistory::outputs() { return {"channel", WheelRig::channels()}; }

const WheelHub& FixWheelHistory::wheel() const { return rig_fix_.wheel_fix().hub(); }

void FixWheelHistory::post_create() {
  FixHistory::post_create();
  add_grain_virial(*lmp);
}

void FixWheelHistory::setup(int vflag) {
  FixHistory::setup(vflag);
  ask_for_grain_virial(*lmp);
}

void FixWheelHistory::open(std::optional<double> resume_time) {
  first_step_ = update->ntimestep;
  first_time_ = time();
  first_energy_ = rig_fix_.wheel_fix().hub().energy_budget().residual();
  const double ground_level = rig_fix_.options().number("ground_level");
  Grains now = gather_grains(*lmp, ground_level);
  if (comm->me != 0) return;
  const ResultsInUse in_use;
  open_rows(rig_fix_.rig().recorded_channels(), options().text("title"), resume_time);
  if (resume_time && now.size() > 0)
    reference_ = read_reference_grains(in_folder("history.h5"));
  else
    reference_ = std::move(now);
  if (!resume_time && reference_.size() > 0) file_->write_reference(reference_);
  wheel_frames_ = open_frames("wheel", resume_time);
  grain_frames_ = open_frames("grains", resume_time);
}

void FixWheelHistory::record() {
  const GroundLosses losses = ground_losses();
  if (!file_) return;
  const ResultsInUse in_use;
  file_->append(rig_fix_.rig().measure(time(), losses));
}

void FixWheelHistory::write_frame() {
  const Grains grains = gather_grains(*lmp, reference_.bed_level);
  if (comm->me != 0) return;
  Surface wheel = rig_fix_.wheel_fix().hub().surface();
  const auto [low, high] = wheel.bounds();
  wheel.x.colwise() += grains.shift_to_image(0.5 * (low + high));
  wheel_frames_->add(time(), wheel);
  if (grains.size() > 0) grain_frames_->add(time(), grains, &reference_);
}

void FixWheelHistory::close() {
  const RunClosing end = closing();
  const Grains grains = gather_grains(*lmp, reference_.bed_level, grain_virial(*lmp));
  if (comm->me != 0) return;
  const ResultsInUse in_use;
  file_->write_final(grains, rig_fix_.wheel_fix().hub().surface());
  file_->write_closing(end);
  file_->flush();
  const std::string& folder = options().text("folder");
  const Summary summary = summarise(folder);
  write_summary(folder, summary);
  verdict_ = "Verdict: " + verdict_of(summary);
  if (screen) fmt::print(screen, "\n{}\n", summary_text(summary));
}

void print_verdicts(LAMMPS_NS::LAMMPS& lammps) {
  if (!lammps.screen) return;
  const std::vector<FixWheelHistory*> histories = fixes_of<FixWheelHistory>(*lammps.modify);
  for (const FixWheelHistory* history : histories)
    if (!history->verdict().empty())
      fmt::print(lammps.screen, "\nSummary: {0}/summary.txt\n{1}{2}\n", history->folder(),
                 error_note(history->folder()), history->verdict());
}

GroundLosses FixWheelHistory::ground_losses() {
  FixWheelHub& wheel = rig_fix_.wheel_fix();
  GroundLosses losses;
  for (const auto* part : fixes_of<const LossLedger>(*modify))
    part->add_losses(wheel.hub(), losses);
  const ContactWork& work = FixCoupledSystem::of(*lmp).contact_work(wheel.hub());
  losses.friction += work.friction;
  losses.contact_damping += work.contact;
  losses.press = work.press;
  losses.push = work.push;
  // remainder of the wheel's work
  losses.contact_springs =
      -wheel.hub().energy_budget().contact_work -
      (losses.continuum + losses.press + losses.push + losses.friction + losses.contact_damping);
  return losses;
}

RunClosing FixWheelHistory::closing() {
  FixCoupledSystem& system = FixCoupledSystem::of(*lmp);
  const WheelHub& wheel = rig_fix_.wheel_fix().hub();
  const EnergyBudget budget = wheel.energy_budget();
  const MomentumAudit& momentum = system.audit(wheel);
  RunClosing end;
  end.audit.set_energies({{"work of the ground on the wheel", budget.contact_work},
                          {"work of the load", budget.load_work},
                          {"work of the drive", budget.drive_work},
                          {"kinetic energy of the wheel", -budget.kinetic_energy},
                          {"stored in the wheel", -budget.stored_energy},
                          {"loss in the wheel and the rig's damping", -budget.dissipated_energy}},
                         budget.residual() - first_energy_);
  end.audit.force_imbalance = momentum.force_imbalance;
  end.audit.force_scale = momentum.force_scale;
  end.audit.moment_imbalance = momentum.moment_imbalance;
  end.audit.moment_scale = momentum.moment_scale;
  end.cost.wall_time = wall_time();
  end.cost.simulated_time = time() - first_time_;
  end.cost.steps = static_cast<long>(update->ntimestep) - first_step_;
  end.cost.grains = static_cast<long>(atom->natoms);
  end.cost.ranks = comm->nprocs;
  end.cost.memory = system.communicator().sum(peak_memory());
  if (update->ntimestep < update->laststep)
    end.warnings.push_back(fmt::format(
        "The run was interrupted at step {} of {}; the values are those of the part that was done.",
        update->ntimestep, update->laststep));
  const bool settling = rig_fix_.rig().stage(time()) == RigStage::settle;
  if (!settling && !system.touched(wheel))
    end.warnings.push_back(
        "Nothing touched the wheel: check its start, ground_level and the contacts of the scene.");
  const std::optional<double> change = rig_fix_.last_change();
  if (change && rig_fix_.rig().stage(*change) == RigStage::cruise)
    end.warnings.push_back(
        fmt::format("The targets of the rig changed during the cruise, the last time at {:.6g} s: "
                    "averages over a window that begins earlier mix them.",
                    *change));
  return end;
}

}  // namespace furrow::coupling

#include "coupling/fix_terrain_history.h"

#include <cmath>

#include <fmt/format.h>

#include "comm.h"
#include "core/error.h"
#include "coupling/fix_terrain_continuum.h"
#include "coupling/guard.h"
#include "coupling/liggghts_access.h"
#include "coupling/restart_record.h"
#include "coupling/results_folder.h"
#include "coupling/words.h"
#include "modify.h"
#include "mpm/snapshot.h"
#include "update.h"

namespace furrow::coupling {

namespace {

FixTerrainContinuum& find_ground(LAMMPS_NS::LAMMPS& lammps, const Options& options) {
  auto* ground = dynamic_cast<FixTerrainContinuum*>(lammps.modify->find_fix_id(options.word("ground").c_str()));
  if (!ground)
    throw InputError(options.where("ground"), fmt::format("is '{}', and there is no such ground", options.word("ground")),
                     "the id of a fix terrain/continuum", "write the fix terrain/continuum before this line");
  return *ground;
}

const std::vector<Channel>& channels() {
  static const std::vector<Channel> list = {
      {"time", "s", "time since the start of the run"},
      {"particles", "", "of all ranks"},
      {"kinetic_energy", "J", "of the particles, affine part included"},
      {"stored_energy", "J", "elastic and frozen, since the start"},
      {"dissipated_energy", "J", "plastic, turned into heat since the start"},
      {"contact_work", "J", "of contacts on the ground"},
      {"load_work", "J", "of gravity and absorbing faces on the ground"},
      {"numerical_loss", "J", "kinetic energy taken by the discretisation"},
      {"residual", "J", "work that is not found in any energy"},
      {"base_impulse", "N s", "vertical impulse of the lower face on the ground since the start"},
      {"travelled", "m", "by the moving grid since the start"},
      {"stable_step", "s", "of the ground now"},
  };
  return list;
}

}  // namespace

Schema FixTerrainHistory::schema() {
  Schema schema("fix terrain/history");
  schema.text("ground", "id of the fix terrain/continuum that is recorded");
  schema.text("folder", "folder for the results; made if need be, earlier results in it are replaced");
  schema.integer("every", Range::at_least(1), "steps between rows of the history");
  schema.integer("vtk", Range::at_least(0), "steps between frames of the ground; 0: none").by_default("0");
  return schema;
}

FixTerrainHistory::FixTerrainHistory(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg),
      options_(schema().read(words_after_style(narg, arg))),
      ground_fix_(find_ground(*lammps, options_)) {
  nevery = 1;
  restart_global = 1;
}

int FixTerrainHistory::setmask() { return LAMMPS_NS::FixConst::END_OF_STEP | LAMMPS_NS::FixConst::POST_RUN; }
bool FixTerrainHistory::needs(LAMMPS_NS::Fix& other) const { return &other == &ground_fix_; }
double FixTerrainHistory::time() const { return FixWorld::of(*lmp).time(); }

void FixTerrainHistory::setup(int) {
  guarded_alone(*error, [&] {
    if (opened_) return;
    opened_ = true;
    open();
    started_ = std::chrono::steady_clock::now();
    if (resume_time_) return;
    record();
    if (options_.integer("vtk") > 0) write_frame();
  });
}

void FixTerrainHistory::open() {
  if (comm->me != 0) return;
  const std::string& folder = options_.word("folder");
  const std::string path = folder + "/ground.h5", frames = folder + "/vtk";
  const bool draw = options_.integer("vtk") > 0;
  if (resume_time_) {
    file_ = HistoryFile::resume(path, channels(), *resume_time_);
    if (draw) frames_ = VtkSeries::resume(frames, "ground", *resume_time_);
    return;
  }
  make_results_folder(options_);
  RunInfo info;
  info.title = "ground";
  info.script = script_name(*lmp);
  info.effective_input = effective_input(*lmp);
  info.ranks = comm->nprocs;
  file_ = HistoryFile::create(path, channels(), info);
  if (draw) frames_ = VtkSeries::create(frames, "ground");
}

void FixTerrainHistory::keep_results() {
  if (file_) file_->flush();
}

void FixTerrainHistory::end_of_step() {
  guarded_alone(*error, [&] {
    if (update->ntimestep % options_.integer("every") == 0) record();
    const long vtk = options_.integer("vtk");
    if (vtk > 0 && update->ntimestep % vtk == 0) write_frame();
  });
}

void FixTerrainHistory::record() {
  const MpmGround& ground = ground_fix_.ground();
  const Balance balance = ground.balance();
  const std::vector<double> row = {time(),
                                   ground.particle_count(),
                                   balance.kinetic_energy,
                                   balance.stored_energy,
                                   balance.dissipated_energy,
                                   balance.contact_work,
                                   balance.load_work,
                                   balance.numerical_loss,
                                   balance.residual(),
                                   ground.face_impulse(z_lower).z(),
                                   ground.travelled(),
                                   ground.stable_time_step()};
  if (file_) file_->append(row);
}

void FixTerrainHistory::write_frame() {
  const GroundSnapshot snapshot = take_snapshot(ground_fix_.ground());
  if (frames_) frames_->add(time(), snapshot);
}

void FixTerrainHistory::post_run() {
  guarded_alone(*error, [&] {
    MpmGround& ground = ground_fix_.ground();
    const Balance balance = ground.balance();
    const GroundSnapshot snapshot = take_snapshot(ground);
    const std::vector<RutPoint> rut = collect_rut(ground);
    if (!file_) return;
    RunClosing end;
    end.audit.energies = {{"work of contacts on the ground", balance.contact_work},
                          {"work of gravity and absorbing faces", balance.load_work},
                          {"kinetic energy", -balance.kinetic_energy},
                          {"stored energy", -balance.stored_energy},
                          {"plastic dissipation", -balance.dissipated_energy},
                          {"numerical loss", -balance.numerical_loss}};
    end.audit.energy_residual = balance.residual();
    for (const EnergyTerm& term : end.audit.energies)
      end.audit.energy_scale = std::max(end.audit.energy_scale, std::abs(term.value));
    end.cost.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
    end.cost.ranks = comm->nprocs;
    file_->write_ground(snapshot, rut);
    file_->write_closing(end);
    file_->flush();
  });
}

void FixTerrainHistory::write_restart(FILE* checkpoint) {
  if (comm->me != 0) return;
  guarded_alone(*error, [&] {
    if (file_) file_->flush();
  });
  write_record(checkpoint, {time()});
}

void FixTerrainHistory::restart(char* buffer) { resume_time_ = *reinterpret_cast<const double*>(buffer); }

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/output/fix_terrain_history.h"

#include <fmt/format.h>

#include "comm.h"
#include "core/error.h"
#include "coupling/terrain/fix_terrain_continuum.h"
#include "coupling/output/results_folder.h"
#include "modify.h"
#include "mpm/terrain_snapshot.h"

namespace furrow::coupling {

namespace {

FixTerrainContinuum& find_terrain(LAMMPS_NS::LAMMPS& lammps, const Options& options) {
  auto* ground = dynamic_cast<FixTerrainContinuum*>(
      lammps.modify->find_fix_id(options.text("ground").c_str()));
  if (!ground)
    throw InputError(options.where("ground"),
                     fmt::format("is '{}', and there is no such ground", options.text("ground")),
                     "the id of a fix terrain/continuum",
                     "write the fix terrain/continuum before this line");
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
  add_keys(schema, "the ground");
  return schema;
}

FixTerrainHistory::FixTerrainHistory(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixHistory(lammps, narg, arg, schema()), terrain_fix_(find_terrain(*lammps, options())) {}

bool FixTerrainHistory::uses(LAMMPS_NS::Fix& other) const { return &other == &terrain_fix_; }

void FixTerrainHistory::open(std::optional<double> resume_time) {
  if (comm->me != 0) return;
  const std::string& folder = options().text("folder");
  const std::string path = folder + "/ground.h5", frames = folder + "/vtk";
  if (resume_time) {
    file_ = HistoryFile::resume(path, channels(), *resume_time);
    if (draws()) frames_ = VtkSeries::resume(frames, "ground", *resume_time);
    return;
  }
  make_results_folder(options());
  file_ = HistoryFile::create(path, channels(), run_info("ground"));
  if (draws()) frames_ = VtkSeries::create(frames, "ground");
}

void FixTerrainHistory::record() {
  const ContinuumTerrain& ground = terrain_fix_.ground();
  const EnergyBudget budget = ground.energy_budget();
  const std::vector<double> row = {time(),
                                   ground.particle_count(),
                                   budget.kinetic_energy,
                                   budget.stored_energy,
                                   budget.dissipated_energy,
                                   budget.contact_work,
                                   budget.load_work,
                                   budget.numerical_loss,
                                   budget.residual(),
                                   ground.boundary_impulse(Face::z_lower).z(),
                                   ground.travelled(),
                                   ground.stable_time_step()};
  if (file_) file_->append(row);
}

void FixTerrainHistory::write_frame() {
  const TerrainSnapshot snapshot = take_snapshot(terrain_fix_.ground());
  if (frames_) frames_->add(time(), snapshot);
}

void FixTerrainHistory::close() {
  ContinuumTerrain& ground = terrain_fix_.ground();
  const EnergyBudget budget = ground.energy_budget();
  const TerrainSnapshot snapshot = take_snapshot(ground);
  const std::vector<RutPoint> rut = collect_rut(ground);
  if (!file_) return;
  RunClosing end;
  end.audit.set_energies({{"work of contacts on the ground", budget.contact_work},
                          {"work of gravity and absorbing faces", budget.load_work},
                          {"kinetic energy", -budget.kinetic_energy},
                          {"stored energy", -budget.stored_energy},
                          {"plastic dissipation", -budget.dissipated_energy},
                          {"numerical loss", -budget.numerical_loss}},
                         budget.residual());
  end.cost.wall_time = wall_time();
  end.cost.ranks = comm->nprocs;
  file_->write_terrain(snapshot, rut);
  file_->write_closing(end);
  file_->flush();
}

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/output/histories/fix_terrain_history.h"

#include "comm.h"
#include "coupling/liggghts/errors/rescue.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "coupling/base/roles/fix_terrain.h"
#include "furrow/mpm/terrain_outputs.h"
#include "furrow/mpm/terrain_snapshot.h"

namespace furrow::coupling {

namespace {

std::vector<Channel> channels() {
  std::vector<Channel> list = {{"time", "s", "time since the start of the run"}};
  for (const Channel& channel : terrain_outputs().channels()) list.push_back(channel);
  return list;
}

}  // namespace

const StyleRow terrain_history_style = fix_style<FixTerrainHistory>(
    "terrain/history", "history", "output/histories/fix_terrain_history.md");

Schema FixTerrainHistory::schema() {
  Schema schema("fix terrain/history");
  schema.text("terrain", "id of the fix of the terrain");
  add_keys(schema, "the terrain");
  schema.alias("ground", "terrain");
  return schema;
}

OutputTable FixTerrainHistory::outputs() { return {"channel", channels()}; }

FixTerrainHistory::FixTerrainHistory(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixHistory(lammps, narg, arg, schema()),
      terrain_fix_(use<FixTerrain>("terrain", {"terrain"})) {}

void FixTerrainHistory::open(std::optional<double> resume_time) {
  if (comm->me != 0) return;
  const ResultsInUse in_use;
  open_rows("terrain.h5", channels(), "terrain", resume_time);
  frames_ = open_frames("terrain", resume_time);
}

void FixTerrainHistory::record() {
  TerrainReading reading(terrain_fix_.terrain());
  std::vector<double> row = {time()};
  for (const double value : terrain_outputs().values(reading)) row.push_back(value);
  if (!file_) return;
  const ResultsInUse in_use;
  file_->append(row);
}

void FixTerrainHistory::write_frame() {
  const TerrainSnapshot snapshot = take_snapshot(terrain_fix_.terrain());
  if (frames_) frames_->add(time(), snapshot);
}

void FixTerrainHistory::close() {
  ContinuumTerrain& terrain = terrain_fix_.terrain();
  const EnergyBudget budget = terrain.energy_budget();
  const TerrainSnapshot snapshot = take_snapshot(terrain);
  const std::vector<RutPoint> rut = collect_rut(terrain);
  if (!file_) return;
  RunClosing end;
  end.audit.set_energies({{"work of contacts on the terrain", budget.contact_work},
                          {"work of gravity and absorbing faces", budget.load_work},
                          {"kinetic energy", -budget.kinetic_energy},
                          {"stored energy", -budget.stored_energy},
                          {"plastic dissipation", -budget.dissipated_energy},
                          {"numerical loss", -budget.numerical_loss}},
                         budget.residual());
  end.cost.wall_time = wall_time();
  end.cost.ranks = comm->nprocs;
  const ResultsInUse in_use;
  file_->write_terrain(snapshot, rut);
  file_->write_closing(end);
  file_->flush();
}

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/output/histories/fix_terrain_history.h"

#include <algorithm>

#include "comm.h"
#include "coupling/base/roles/ground.h"
#include "coupling/liggghts/errors/rescue.h"
#include "coupling/liggghts/styles/style_registry.h"

namespace furrow::coupling {

namespace {

const Channel time_channel = {"time", "s", "time since the start of the run"};

void write_end(HistoryFile& file, const TerrainSnapshot& particles,
               const std::vector<RutPoint>& rut) {
  file.write_terrain(particles, rut);
}
void write_end(HistoryFile& file, const Surface& surface, const std::vector<RutPoint>&) {
  file.write_final(Grains(), surface);
}

}  // namespace

const StyleRow terrain_history_style = fix_style<FixTerrainHistory>(
    "terrain/history", "history", "output/histories/fix_terrain_history.md", {"scm/history"});

Schema FixTerrainHistory::schema() {
  Schema schema("fix terrain/history");
  schema.text("terrain", "id of the fix of the terrain");
  add_keys(schema, "the terrain");
  schema.alias("ground", "terrain");
  return schema;
}

/// The channels of all terrains, which are their outputs.
OutputTable FixTerrainHistory::outputs() {
  OutputTable table = {"channel", {time_channel}};
  for (const Style& style : styles())
    if (std::count(terrain_kinds.begin(), terrain_kinds.end(), style.kind) > 0)
      for (const Channel& channel : style.outputs().rows) table.rows.push_back(channel);
  return table;
}

FixTerrainHistory::FixTerrainHistory(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixHistory(lammps, narg, arg, schema()), terrain_(use<Terrain>("terrain", terrain_kinds)) {
  take_file(terrain_.series() + ".h5");
}

void FixTerrainHistory::open(std::optional<double> resume_time) {
  if (comm->me != 0) return;
  const ResultsInUse in_use;
  std::vector<Channel> channels = terrain_.channels();
  channels.insert(channels.begin(), time_channel);
  open_rows(channels, terrain_.title(), resume_time);
  frames_ = open_frames(terrain_.series(), resume_time);
}

void FixTerrainHistory::record() {
  std::vector<double> row = terrain_.values();
  row.insert(row.begin(), time());
  if (!file_) return;
  const ResultsInUse in_use;
  file_->append(row);
}

void FixTerrainHistory::write_frame() {
  const auto snapshot = terrain_.snapshot();
  if (frames_) std::visit([&](const auto& shape) { frames_->add(time(), shape); }, snapshot);
}

void FixTerrainHistory::close() {
  const std::optional<EnergyBudget> budget = terrain_.energy_budget();
  const auto snapshot = terrain_.snapshot();
  const std::vector<RutPoint> rut = terrain_.rut();
  if (!file_) return;
  RunClosing end;
  if (budget)
    end.audit.set_energies({{"work of contacts on the terrain", budget->contact_work},
                            {"work of gravity and absorbing faces", budget->load_work},
                            {"kinetic energy", -budget->kinetic_energy},
                            {"stored energy", -budget->stored_energy},
                            {"plastic dissipation", -budget->dissipated_energy},
                            {"numerical loss", -budget->numerical_loss}},
                           budget->residual());
  end.cost.wall_time = wall_time();
  end.cost.ranks = comm->nprocs;
  const ResultsInUse in_use;
  std::visit([&](const auto& shape) { write_end(*file_, shape, rut); }, snapshot);
  file_->write_closing(end);
  file_->flush();
}

}  // namespace furrow::coupling

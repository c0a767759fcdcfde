// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/output/histories/fix_scm_history.h"

#include "comm.h"
#include "coupling/base/roles/fix_scm.h"
#include "coupling/liggghts/errors/rescue.h"
#include "coupling/liggghts/styles/style_registry.h"

namespace furrow::coupling {

namespace {

std::vector<Channel> scm_channels() {
  std::vector<Channel> list = {{"time", "s", "time since the start of the run"}};
  for (const Channel& channel : FixScm::outputs().channels()) list.push_back(channel);
  return list;
}

}  // namespace

const StyleRow scm_history_style =
    fix_style<FixScmHistory>("scm/history", "history", "output/histories/fix_scm_history.md");

Schema FixScmHistory::schema() {
  Schema schema("fix scm/history");
  schema.text("terrain", "id of the fix of the height field");
  add_keys(schema, "the surface");
  return schema;
}

OutputTable FixScmHistory::outputs() { return {"channel", scm_channels()}; }

FixScmHistory::FixScmHistory(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixHistory(lammps, narg, arg, schema()), terrain_fix_(use<FixScm>("terrain", {"scm"})) {}

void FixScmHistory::open(std::optional<double> resume_time) {
  if (comm->me != 0) return;
  const ResultsInUse in_use;
  open_rows("scm.h5", scm_channels(), "height field", resume_time);
  frames_ = open_frames("scm", resume_time);
}

void FixScmHistory::record() {
  if (!file_) return;
  std::vector<double> row = {time()};
  for (const double value : FixScm::outputs().values(terrain_fix_)) row.push_back(value);
  const ResultsInUse in_use;
  file_->append(row);
}

void FixScmHistory::write_frame() {
  if (frames_) frames_->add(time(), terrain_fix_.field().triangles());
}

void FixScmHistory::close() {
  if (!file_) return;
  RunClosing end;
  end.cost.wall_time = wall_time();
  end.cost.ranks = comm->nprocs;
  const ResultsInUse in_use;
  file_->write_final(Grains(), terrain_fix_.field().triangles());
  file_->write_closing(end);
  file_->flush();
}

}  // namespace furrow::coupling

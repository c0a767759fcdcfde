// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix terrain/history: the results of a terrain. See fix_terrain_history.md.

#include "coupling/output/histories/fix_history.h"
#include "furrow/io/formats/vtk_file.h"

namespace furrow::coupling {

class Terrain;

class FixTerrainHistory : public FixHistory {
 public:
  FixTerrainHistory(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static OutputTable outputs();

 private:
  void open(std::optional<double> resume_time) override;
  void record() override;
  void write_frame() override;
  void close() override;

  Terrain& terrain_;
  std::optional<VtkSeries> frames_;  // rank 0 only
};

}  // namespace furrow::coupling

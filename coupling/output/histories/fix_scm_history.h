// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix scm/history: the surface of a height field over time. See fix_scm_history.md.

#include "coupling/output/histories/fix_history.h"
#include "furrow/io/formats/vtk_file.h"

namespace furrow::coupling {

class FixScm;

class FixScmHistory : public FixHistory {
 public:
  FixScmHistory(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static OutputTable outputs();

 private:
  void open(std::optional<double> resume_time) override;
  void record() override;
  void write_frame() override;
  void close() override;

  FixScm& terrain_fix_;
  std::optional<VtkSeries> frames_;  // rank 0 only
};

}  // namespace furrow::coupling

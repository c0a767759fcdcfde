// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix ave/time: LIGGGHTS's own, whose sums and file go on when a run is continued. See
/// ../restart/command_read_restart.md.

#include <string>

#include "coupling/liggghts/styles/style_registry.h"
#include "fix_ave_time.h"

namespace furrow::coupling {

class FixAveTime : public LAMMPS_NS::FixAveTime {
 public:
  FixAveTime(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema() { return Schema("fix ave/time"); }
  static OutputTable outputs() { return {}; }

  void init() override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;

 private:
  struct EarlierFile {
    std::string path, text;  // on rank 0, of a run that is continued
  };
  FixAveTime(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, EarlierFile earlier);
  static EarlierFile earlier_file(const LAMMPS_NS::LAMMPS& lammps, int narg, char** arg);
  std::string rows_until_now() const;

  EarlierFile earlier_;
  bool restored_ = false;
};

}  // namespace furrow::coupling

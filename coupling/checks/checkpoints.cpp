// SPDX-License-Identifier: GPL-2.0-or-later
// Rules for the checkpoints that the lines 'restart' ask for: their names and their size.

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "furrow/core/communicator.h"
#include "coupling/base/roles/grain_bed.h"
#include "coupling/checks/scene_checks.h"
#include "coupling/liggghts/data/access.h"
#include "coupling/liggghts/checkpoint_file.h"
#include "coupling/terrain/bed/fix_bed_window.h"

namespace furrow::coupling {

namespace {

namespace fs = std::filesystem;

constexpr double gigabyte = 1e9;
constexpr double longest_record = std::numeric_limits<int>::max();  // LIGGGHTS reads its length

/// Room [bytes] that has to be free before the first of these checkpoints: all of them, and one
/// that is written before it replaces another.
double bytes_needed(const std::vector<std::string>& names, double size) {
  double there = 0.0, kept = 0.0;
  for (const std::string& name : names) {
    if (name.find('*') == std::string::npos) kept += size;
    there += static_cast<double>(bytes_of_checkpoint(name));
  }
  return std::max(size, kept + size - there);
}

fs::path existing_folder(const std::string& name) {
  std::error_code ignored;
  fs::path folder = fs::absolute(name, ignored).parent_path();
  while (!fs::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

}  // namespace

CheckResult checkpoints_have_one_run(const Scene& scene) {
  const Communicator ranks(&scene.lammps.world);
  for (const std::string& name : checkpoint_names(scene.lammps))
    if (ranks.any(ranks.rank() == 0 && belongs_to_another_run(name)))
      return refusal("restart",
                     fmt::format("names '{}', to which another run writes its checkpoints", name),
                     "separate names for each run in a folder",
                     "name other files, or wait until that run has ended");
  return {};
}

CheckResult checkpoints_have_room(const Scene& scene) {
  const std::vector<std::string> names = checkpoint_names(scene.lammps);
  if (names.empty()) return {};
  const Communicator ranks(&scene.lammps.world);
  double size = 0.0;
  for (const Ground* ground : Grounds(scene.lammps)) size += ground->checkpoint_size();
  double free = -1.0, needed = 0.0;
  if (ranks.rank() == 0) {
    std::error_code unknown;
    const fs::space_info space = fs::space(existing_folder(names[0]), unknown);
    if (!unknown && space.capacity > 0) free = static_cast<double>(space.available);
    needed = bytes_needed(names, size);
  }
  free = ranks.max(free);
  needed = ranks.max(needed);
  if (free < 0.0 || needed <= free) return {};
  return refusal(
      "restart",
      fmt::format(
          "writes checkpoints of {:.3g} GB, which need {:.3g} GB on the disk, and {:.3g} GB "
          "are free",
          size / gigabyte, needed / gigabyte, free / gigabyte),
      fmt::format("at least {:.3g} GB free", needed / gigabyte),
      fmt::format("make room, name files on another disk than that of '{}', or remove the line",
                  names[0]));
}

CheckResult bed_fits_a_record(const Scene& scene, const FixBedWindow& window) {
  const double grains =
      checkpoint_names(scene.lammps).empty() ? 0.0 : GrainBed(scene.lammps).checkpoint_size();
  if (grains <= longest_record) return {};
  return refusal(window.name(),
                 fmt::format("keeps the bed in {:.3g} GB of a checkpoint", grains / gigabyte),
                 fmt::format("at most {:.3g} GB, the longest record of a LIGGGHTS restart file",
                             longest_record / gigabyte),
                 "choose a smaller bed, or remove the line 'restart'");
}

}  // namespace furrow::coupling

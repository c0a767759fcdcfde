// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Checkpoints (restart files of LIGGGHTS) that are whole or absent. See command_read_restart.md.

#include <functional>
#include <string>

#include "lammps.h"

namespace furrow::coupling {

/// Has LIGGGHTS write a restart file into memory, because it does not look whether its writes
/// succeed, and writes that to the disk as a SealedFile. Collective.
/// @param write LIGGGHTS's own function; gets the name of a file to write
/// @throws Error on all ranks, naming the file and the reason; a former file of that name stays
void write_checkpoint(LAMMPS_NS::LAMMPS& lammps, const std::string& path,
                      const std::function<void(char* name)>& write);

/// @param path of a checkpoint; a '*' stands for a step, and means the latest
/// @return the path without '*'. Collective. @throws Error on all ranks
std::string find_checkpoint(LAMMPS_NS::LAMMPS& lammps, const std::string& path);

/// @throws Error on all ranks, naming the file and what is wrong with it, unless it is a whole
/// checkpoint. Collective
void check_checkpoint(LAMMPS_NS::LAMMPS& lammps, const std::string& path);
/// For a restart file without a seal: only that there is one. Collective. @throws Error
void check_restart_file(LAMMPS_NS::LAMMPS& lammps, const std::string& path);

}  // namespace furrow::coupling

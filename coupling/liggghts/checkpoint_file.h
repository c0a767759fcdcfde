// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Checkpoints that are whole or absent. See command_read_restart.md.
///
/// A checkpoint 'ck' is a restart file of LIGGGHTS and the folder 'ck.particles', in which each
/// rank keeps the particles of its terrain: files "<set>.<fix>.<rank>". Every checkpoint begins a
/// new set, whose name is in the restart file. The set is complete before the restart file takes
/// its name; older sets are removed after that.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "furrow/io/files/rank_files.h"
#include "lammps.h"

namespace furrow::coupling {

/// Has LIGGGHTS write a restart file into memory, because it does not look whether its writes
/// succeed, and writes that to the disk as a SealedFile. Collective.
/// @param write LIGGGHTS's own function; gets the name of a file to write
/// @throws Error on all ranks, naming the file and the reason; a former file of that name stays
void write_checkpoint(LAMMPS_NS::LAMMPS& lammps, const std::string& path,
                      const std::function<void(char* name)>& write);

/// Name of the set of the checkpoint that is being written; empty outside of write_checkpoint().
const std::string& set_being_written();
/// Files of the ranks for a fix: of the checkpoint that is being written, or else of that which
/// read_restart has read. @param set its name
std::unique_ptr<RankFiles> rank_files(const LAMMPS_NS::LAMMPS& lammps, const std::string& set,
                                      const std::string& fix);
/// Closes the file of each rank. Collective. @throws Error on all ranks when one is not written
void close_rank_files(const LAMMPS_NS::LAMMPS& lammps, RankFiles& files);
/// Size on the disk of a checkpoint that may be there: restart file and particles.
std::uintmax_t bytes_of_checkpoint(const std::string& path);
/// True if the line 'restart' of another run in progress replaces this restart file.
bool belongs_to_another_run(const std::string& path);
/// Records that the run continues from this checkpoint.
void note_checkpoint_read(const std::string& path);
/// Checkpoint from which the run continues; empty for a run from the start.
const std::string& checkpoint_read();

/// @param path of a checkpoint; a '*' stands for a step, and means the latest
/// @return the path without '*'. Collective. @throws Error on all ranks
std::string find_checkpoint(LAMMPS_NS::LAMMPS& lammps, const std::string& path);

/// @throws Error on all ranks, naming the file and what is wrong with it, unless it is a whole
/// checkpoint. Collective
void check_checkpoint(LAMMPS_NS::LAMMPS& lammps, const std::string& path);
/// Checks that a restart file without a seal exists, and no more. Collective. @throws Error
void check_restart_file(LAMMPS_NS::LAMMPS& lammps, const std::string& path);

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What Furrow needs of LIGGGHTS beyond its public interface, gathered in one place.

#include <string>

#include <mpi.h>

#include "lammps.h"
#include "fix.h"
#include "fix_contact_history_mesh.h"
#include "fix_mesh_surface.h"

namespace furrow::coupling {

/// Throws furrow::Error when the LIGGGHTS library is not the one this executable was built for: its
/// classes are used by layout.
void check_library(const LAMMPS_NS::LAMMPS& lammps);

using FixCreator = LAMMPS_NS::Fix* (*)(LAMMPS_NS::LAMMPS*, int, char**);
using CommandCreator = void (*)(LAMMPS_NS::LAMMPS*, int, char**);
/// Adds a fix style or a command to the tables that LIGGGHTS searches (Modify::fix_map,
/// Input::command_map; both private).
void add_fix_style(LAMMPS_NS::LAMMPS& lammps, const std::string& style, FixCreator creator);
void add_command(LAMMPS_NS::LAMMPS& lammps, const std::string& name, CommandCreator creator);

/// "in.wheel, line 12: fix wheel all ..." of the command being executed; empty outside a script.
/// Rank 0 only.
std::string script_position(const LAMMPS_NS::LAMMPS& lammps);

/// Path of the script being read; empty for standard input. Rank 0 only.
std::string script_name(const LAMMPS_NS::LAMMPS& lammps);
/// Folder of that script, from which files named in a script are found; empty for the current
/// folder. Collective.
std::string script_folder(const LAMMPS_NS::LAMMPS& lammps);

/// Gives a mesh fix another mesh (FixMesh::mesh_, private); the old one is deleted.
void replace_mesh(LAMMPS_NS::FixMesh& fix, LAMMPS_NS::AbstractMesh* mesh);

/// The slot of a contact that was there at the last step and has not been seen in this one
/// (FixContactHistoryMesh, protected).
bool contact_seen(LAMMPS_NS::FixContactHistoryMesh& history, int grain, int slot);

}  // namespace furrow::coupling

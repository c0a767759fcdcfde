// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Members of LIGGGHTS's classes that are not public.

#include <cstdio>
#include <string>
#include <vector>

#include "lammps.h"
#include "fix.h"
#include "fix_ave_time.h"
#include "fix_contact_history_mesh.h"
#include "fix_mesh_surface.h"

namespace furrow::coupling {

using FixCreator = LAMMPS_NS::Fix* (*)(LAMMPS_NS::LAMMPS*, int, char**);
using CommandCreator = void (*)(LAMMPS_NS::LAMMPS*, int, char**);

/// Adds a fix style or a command to the tables that LIGGGHTS searches (Modify::fix_map,
/// Input::command_map; both private). One that is there is replaced.
void add_fix_style(LAMMPS_NS::LAMMPS& lammps, const std::string& style, FixCreator creator);
void add_command(LAMMPS_NS::LAMMPS& lammps, const std::string& name, CommandCreator creator);
bool has_fix_style(const LAMMPS_NS::LAMMPS& lammps, const std::string& style);
bool has_command(const LAMMPS_NS::LAMMPS& lammps, const std::string& name);

/// Number of open scripts, one within the other (Input::nfile, private). Rank 0 only.
int open_scripts(const LAMMPS_NS::LAMMPS& lammps);

/// The line being executed (Input::line, private), or null.
const char* current_line(const LAMMPS_NS::LAMMPS& lammps);

/// The command being executed with its words, as LIGGGHTS has split it: "run", "400"; empty when
/// there is none. (Input::command, protected, and Input::arg)
std::vector<std::string> current_command(const LAMMPS_NS::LAMMPS& lammps);

/// Styles of the fixes whose state LIGGGHTS has read from a restart file and keeps for them
/// (Modify::style_restart_global, protected); until the next run begins.
std::vector<std::string> styles_in_restart_file(const LAMMPS_NS::LAMMPS& lammps);

/// Gives a mesh fix another mesh (FixMesh::mesh_, private), which it then owns; the old one is
/// deleted.
void replace_mesh(LAMMPS_NS::FixMesh& fix, LAMMPS_NS::AbstractMesh* mesh);

/// The file that a fix ave/time writes (FixAveTime::fp, private); null on other ranks.
FILE* file_of(const LAMMPS_NS::FixAveTime& fix);

/// Names of the files that the lines "restart" ask for (Output::restart1, restart2a and restart2b,
/// private); a '*' stands for the step.
std::vector<std::string> checkpoint_names(const LAMMPS_NS::LAMMPS& lammps);

/// True if the contact in this slot has been found again in the present step
/// (FixContactHistoryMesh::keepflag_, protected).
bool contact_seen(LAMMPS_NS::FixContactHistoryMesh& history, int grain, int slot);

}  // namespace furrow::coupling

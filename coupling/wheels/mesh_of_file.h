// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Common functions of the fixes of bodies from mesh files.

#include "coupling/base/fix_body.h"
#include "furrow/geometry/meshes/solid_mesh.h"

namespace furrow::coupling {

/// Reads the mesh of keyword 'file', relative to the script. Collective. @throws InputError
SolidMesh mesh_of_file(LAMMPS_NS::LAMMPS& lammps, const Options& options);

/// A run continues with the mesh that it began with.
void match_mesh(Checkpoint& state, const FixBody& fix);

}  // namespace furrow::coupling

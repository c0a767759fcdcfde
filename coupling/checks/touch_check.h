// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What can touch what?

#include "coupling/checks/scene_checks.h"
#include "coupling/bodies/fix_body.h"

namespace furrow::coupling {

class FixMeshBody;

/// A stock wall would move grains without moving the body.
/// @throws InputError when a wall/gran holds a mesh/body
void check_mesh_walls(const LAMMPS_NS::LAMMPS& lammps);

/// @throws InputError when a move/mesh moves a mesh/body, which would jump back in every step
void check_mesh_motion(const LAMMPS_NS::LAMMPS& lammps);

/// A wheel may be meant to be free, and a mesh to be drawn only: warnings.
void warn_of_bodies_that_touch_nothing(const LAMMPS_NS::LAMMPS& lammps, const Warn& warn);

/// Two wheels that a copied line has put into one another.
void warn_of_bodies_in_one_place(const LAMMPS_NS::LAMMPS& lammps, const Warn& warn);

/// A contact/plane at a level within the terrain that its body presses on.
void warn_of_planes_in_terrain(const LAMMPS_NS::LAMMPS& lammps, const Warn& warn);

/// Is a mesh of this body in a wall/gran/body?
bool touches_grains(const LAMMPS_NS::LAMMPS& lammps, const FixBody& body);

}  // namespace furrow::coupling

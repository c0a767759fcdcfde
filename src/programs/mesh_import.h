// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Mesh files of other programs.

#include <string>

#include "furrow/geometry/meshes/solid_mesh.h"

namespace furrow {

/// STL, OBJ and VTP as wheels read them; other formats, such as PLY and DAE, by Assimp.
/// @throws InputError
SolidMesh import_mesh(const std::string& path);

}  // namespace furrow

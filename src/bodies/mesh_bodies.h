// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Rigid wheels and tools from mesh files: the keys, and the bodies that they describe.

#include <memory>
#include <string>
#include <vector>

#include "furrow/bodies/rigid_plate.h"
#include "furrow/bodies/rigid_wheel.h"
#include "furrow/core/options/options.h"
#include "furrow/geometry/meshes/solid_mesh.h"

namespace furrow {

/// Place and unit of a wheel in its mesh file.
struct MeshPlacement {
  double scale = 1.0;                ///< [m] of a unit of the file
  Vector3 origin = Vector3::Zero();  ///< in the coordinates of the file
  Vector3 axis = Vector3::UnitY();   ///< in the axes of the file
};

/// The unit that gives a usual size, the centre of mass and the axis of revolution, rounded to what
/// a person would write.
MeshPlacement propose_placement(const Surface& surface);
/// Keywords of a line: "scale 0.001 origin 0 0 0 axis 0 0 1".
std::string keywords(const MeshPlacement& placement);

/// Unit vector along the three numbers of a key. @throws InputError for three zeros
Vector3 direction_from(const Options& options, const std::string& key);

/// The keys of a wheel. @param subject names the owner in errors
Schema mesh_wheel_schema(const std::string& subject);
/// The keys of a plate, but for its motion.
Schema mesh_plate_schema(const std::string& subject);

/// Scales, places and checks the mesh (check_solid). Mass and inertia are those of the keys, or of
/// a solid of uniform density.
/// @param mesh as the file has it
/// @param warnings sentences on a mesh that is no balanced wheel, with explicit mass and inertia
/// @throws InputError for a mesh that is no solid or not in metres, for one that is no balanced
/// wheel without explicit mass and inertia, and for keys that do not go together
std::unique_ptr<RigidWheel> make_mesh_wheel(const Options& options, SolidMesh mesh,
                                            std::vector<std::string>& warnings);
/// @throws InputError for a mesh that is no solid or not in metres
std::unique_ptr<RigidPlate> make_mesh_plate(const Options& options, SolidMesh mesh);

}  // namespace furrow

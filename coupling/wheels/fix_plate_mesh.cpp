// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/wheels/fix_plate_mesh.h"

#include "furrow/bodies/mesh_bodies.h"
#include "coupling/wheels/mesh_of_file.h"
#include "coupling/liggghts/styles/style_registry.h"

namespace furrow::coupling {

const StyleRow plate_mesh_style =
    fix_style<FixPlateMesh>("plate/mesh", "body", "wheels/fix_plate_mesh.md");

Schema FixPlateMesh::schema() {
  Schema schema = mesh_plate_schema("fix plate/mesh");
  declare_motion(schema, "speed along `direction`");
  schema.numbers("direction", 3, "", Range::any(), "direction of motion")
      .by_default(std::vector<double>{0, 0, -1});
  return schema;
}

const Outputs<FixPlateMesh>& FixPlateMesh::outputs() {
  using Fix = FixPlateMesh;
  static const Outputs<Fix> list = {
      {"sinkage", "m", "ground level minus the lowest point of the plate",
       [](Fix& fix) { return fix.sinkage(); }},
      {"force", "N", "upward force of the ground on the plate",
       [](Fix& fix) { return fix.force().z(); }},
      {"pressure", "Pa", "upward force over `area`",
       [](Fix& fix) { return fix.plate().mean_pressure(); }},
      {"torque", "N m", "moment of the ground on the plate about the vertical axis",
       [](Fix& fix) { return fix.plate().torque(); }},
      {"turned", "rad", "angle about the vertical axis since the start",
       [](Fix& fix) { return fix.plate().turned(); }},
      {"force_x", "N", "force of the ground on the plate along x",
       [](Fix& fix) { return fix.force().x(); }},
      {"force_y", "N", "force of the ground on the plate along y",
       [](Fix& fix) { return fix.force().y(); }},
  };
  return list;
}

FixPlateMesh::FixPlateMesh(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixPlateRigid(
          lammps, narg, arg, schema(),
          [lammps](const Options& options) {
            return make_mesh_plate(options, mesh_of_file(*lammps, options));
          },
          [](const Options& options) { return direction_from(options, "direction"); }) {
  provide(outputs());
}

void FixPlateMesh::checkpoint(Checkpoint& state) {
  match_mesh(state, *this);
  FixBody::checkpoint(state);
}

}  // namespace furrow::coupling

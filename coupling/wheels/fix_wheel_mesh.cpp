// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/wheels/fix_wheel_mesh.h"

#include "coupling/wheels/mesh_of_file.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/liggghts/styles/style_registry.h"

namespace furrow::coupling {

const StyleRow wheel_mesh_style =
    fix_style<FixWheelMesh>("wheel/mesh", "wheel", "wheels/fix_wheel_mesh.md");

const Outputs<FixWheelMesh>& FixWheelMesh::outputs() {
  using Fix = FixWheelMesh;
  static const Outputs<Fix> list = {
      {"mass", "kg", "mass of the wheel",
       [](Fix& fix) { return fix.wheel().parameters().hub.inertia.mass; }},
      {"inertia", "kg m^2", "moment of inertia about the axle",
       [](Fix& fix) { return fix.wheel().parameters().hub.inertia.axial; }},
      {"inertia_diametral", "kg m^2", "moment of inertia across the axle",
       [](Fix& fix) { return fix.wheel().parameters().hub.inertia.diametral; }},
      {"radius", "m", "nominal radius", [](Fix& fix) { return fix.wheel().nominal_radius(); }},
      {"width", "m", "width along the axle", [](Fix& fix) { return fix.wheel().nominal_width(); }},
  };
  return list;
}

FixWheelMesh::FixWheelMesh(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixWheelHub(lammps, narg, arg, schema(), [lammps](const Options& options) {
        std::vector<std::string> warnings;
        auto wheel = make_mesh_wheel(options, mesh_of_file(*lammps, options), warnings);
        for (const std::string& warning : warnings) warn(*lammps, warning);
        return wheel;
      }) {
  provide(outputs());
}

void FixWheelMesh::checkpoint(Checkpoint& state) {
  match_mesh(state, *this);
  FixBody::checkpoint(state);
}

}  // namespace furrow::coupling

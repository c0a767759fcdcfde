// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/wheels/mesh_of_file.h"

#include <filesystem>

#include <fmt/format.h>

#include "furrow/core/checksum.h"
#include "coupling/liggghts/styles/script.h"
#include "furrow/io/formats/mesh_file.h"

namespace furrow::coupling {

SolidMesh mesh_of_file(LAMMPS_NS::LAMMPS& lammps, const Options& options) {
  return read_mesh_file(
      (std::filesystem::path(script_folder(lammps)) / options.text("file")).string());
}

void match_mesh(Checkpoint& state, const FixBody& fix) {
  Checksum sum;
  const Matrix3X& x = fix.nodes_as_made();
  sum.add(x.data(), static_cast<std::size_t>(x.size()) * sizeof(double));
  for (const Vector3i& triangle : fix.body().surface().triangles)
    sum.add(triangle.data(), 3 * sizeof(int));
  state.match("checksum of the mesh", fmt::format("{:016x}", sum.value()));
}

}  // namespace furrow::coupling

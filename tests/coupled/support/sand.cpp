// SPDX-License-Identifier: GPL-2.0-or-later
#include "tests/coupled/support/sand.h"

#include <utility>

#include <fmt/format.h>

namespace furrow::test {

void make_sand_bed(Scene& scene, double beside) {
  const double half = 0.5 * SandBed::length;
  scene.granular_box(Vector3(-half, -0.03 - beside, -0.01), Vector3(half, 0.03 + beside, 0.2),
                     0.003, "p f f");
  scene.contact_properties(5e6, 0.3, 0.3, 0.5);
  scene.command(
      "fix roll all property/global coefficientRollingFriction peratomtypepair 2 0.1 0.1 0.1 0.1");
  scene.grains_fall(hertz, SandBed::step, SandBed::gravity);
  using Wall = std::pair<const char*, const char*>;
  for (const auto& [id, plane] :
       {Wall{"left", "yplane -0.03"}, Wall{"right", "yplane 0.03"}, Wall{"floor", "zplane 0"}})
    scene.command(fmt::format("fix {} all wall/gran {} primitive type 1 {}", id, hertz, plane));
  scene.pour(0.004, "block -0.12 0.12 -0.03 0.03 0 0.08", "particles_in_region 1000", "no");
  scene.commands("fix calm all viscous 0.05\nthermo 100000\nrun 24000\nunfix calm");
}

}  // namespace furrow::test

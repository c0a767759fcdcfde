// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix terrain/continuum: terrain by the material point method. See fix_terrain_continuum.md.

#include <optional>
#include <vector>

#include "coupling/base/roles/fix_terrain.h"
#include "coupling/base/roles/motion_controller.h"
#include "furrow/mpm/ground/ground_under_wheel.h"
#include "furrow/mpm/terrain_outputs.h"

namespace furrow::coupling {

class FixTerrainContinuum : public FixTerrain, public MotionController {
 public:
  FixTerrainContinuum(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  /// @param size  of a line that gives none
  static Schema schema(const std::optional<GroundSize>& size = {});
  static const Outputs<TerrainReading>& outputs() { return terrain_outputs(); }

  /// True if the terrain follows this body.
  bool follows(const Body& body) const;

  int setmask() override;
  void end_of_step() override;
  /// Moves along with the bodies that the terrain follows.
  void apply(double time, double dt) override;

 private:
  void check_slabs() const;
  void refuse_overlap();
  void refuse_to_be_left(double middle) const;
  void report();
  void warn_of_extremes();
  void check_energy();

  std::vector<const Body*> followed_;  // the first and, where there are several, the last
};

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Base of fixes whose body is continuum terrain, as the other jobs see it: contacts press on it, a
/// rig tilts its gravity, terrain/history records it.

#include <utility>

#include "coupling/base/fix_body.h"
#include "furrow/mpm/continuum_terrain.h"

namespace furrow::coupling {

class FixTerrain : public FixBody {
 public:
  ContinuumTerrain& terrain() const { return static_cast<ContinuumTerrain&>(body()); }
  bool half_model() const { return options().flag("symmetry"); }
  /// Factor from sums over the computed half to outputs, which are those of the whole terrain.
  double symmetry_factor() const { return half_model() ? 2.0 : 1.0; }
  /// True if the terrain follows a body, and drops the ground that lies behind it.
  bool moves() const { return options().given("follow"); }
  /// Extent of the undisturbed terrain along x, y or z [m].
  std::pair<double, double> extent(int direction) const;
  /// True if a point lies in the undisturbed terrain, whose trough is no part of it.
  bool contains(const Vector3& point) const;

  /// Restores the terrain without keeping a copy as its script line makes it.
  void restart(char* buffer) override { FurrowFix::restart(buffer); }

 protected:
  using FixBody::FixBody;
  /// The particles of each rank go to its own file.
  void checkpoint(Checkpoint& state) override;
};

}  // namespace furrow::coupling

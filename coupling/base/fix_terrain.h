// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Base of fixes whose body is continuum terrain, as the other jobs see it: contacts press on it, a
/// rig tilts its gravity, terrain/history records it.

#include <utility>

#include "coupling/base/fix_body.h"
#include "mpm/continuum_terrain.h"

namespace furrow::coupling {

class FixTerrain : public FixBody {
 public:
  ContinuumTerrain& terrain() const { return static_cast<ContinuumTerrain&>(body()); }
  bool half_model() const { return options().flag("symmetry"); }
  /// Outputs of a half model are those of the whole terrain: a sum over the computed half times
  /// this.
  double symmetry_factor() const { return half_model() ? 2.0 : 1.0; }
  /// Whether it follows a body, and drops what lies behind it.
  bool moves() const { return options().given("follow"); }
  /// Of the undisturbed terrain along x, y or z [m].
  std::pair<double, double> extent(int direction) const;
  /// Whether a point lies in the undisturbed terrain; a trough does not belong to it.
  bool contains(const Vector3& point) const;

  /// Without a copy of the terrain as its line makes it.
  void restart(char* buffer) override { FurrowFix::restart(buffer); }

 protected:
  using FixBody::FixBody;
  /// The particles of each rank go to its own file.
  void checkpoint(Checkpoint& state) override;
};

}  // namespace furrow::coupling

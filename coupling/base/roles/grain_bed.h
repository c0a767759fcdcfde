// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The grains of a scene as ground.

#include "coupling/base/roles/ground.h"

namespace furrow::coupling {

class GrainBed : public Ground {
 public:
  explicit GrainBed(LAMMPS_NS::LAMMPS& lammps) : lammps_(lammps) {}
  /// Edges of the box; a periodic box has no end.
  std::pair<double, double> extent(int direction) const override;
  /// Top of the highest grain within the body's outline from above, of all ranks.
  std::optional<Level> level_under(const Body& body) const override;
  std::vector<GivenGravity> gravities() const override;
  /// Grains with all that rides with them, of all ranks.
  double checkpoint_size() const override;

 private:
  LAMMPS_NS::LAMMPS& lammps_;
};

/// All ground of a scene: terrains in the order of their lines, then the bed if there are grains.
class Grounds {
 public:
  explicit Grounds(LAMMPS_NS::LAMMPS& lammps);
  Grounds(const Grounds&) = delete;
  auto begin() const { return all_.begin(); }
  auto end() const { return all_.end(); }

 private:
  GrainBed bed_;
  std::vector<const Ground*> all_;
};

}  // namespace furrow::coupling

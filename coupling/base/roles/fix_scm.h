// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Base of the fix whose ground is a height field.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupling/base/furrow_fix.h"
#include "coupling/base/roles/ground.h"
#include "furrow/io/inputs/soil_card_file.h"
#include "furrow/scm/height_field.h"
#include "furrow/scm/soil.h"

namespace furrow::coupling {

class FixScm : public FurrowFix, public Terrain {
 public:
  static const Outputs<FixScm>& outputs();
  HeightField& field() { return field_; }
  const HeightField& field() const { return field_; }
  /// Soils of the line and of its patches; none: a surface alone, for contact/rft.
  const std::optional<SoilPatches>& soils() const { return soils_; }
  const std::optional<SoilCard>& card() const { return card_; }

  const Options& line() const override { return options(); }
  double level() const override { return field_.parameters().level; }
  /// The ground has no base.
  std::pair<double, double> extent(int direction) const override;
  /// None unless the line gives it or a card depends on it.
  std::vector<GivenGravity> gravities() const override;
  double checkpoint_size() const override;
  Vector3 shortest_cell() const override { return Vector3::Constant(field_.cell()); }
  Vector3 cells_across(const Vector3& lower, const Vector3& upper) const override;
  std::string finer_cells() const override { return "choose smaller cells, in m"; }
  KnownContact known_contact() const override;

  std::string title() const override { return "height field"; }
  std::string series() const override { return "scm"; }
  std::vector<Channel> channels() const override { return outputs().channels(); }
  std::vector<double> values() override { return outputs().values(*this); }
  std::variant<TerrainSnapshot, Surface> snapshot() override { return field_.triangles(); }
  const Surface& surface() override;

 protected:
  FixScm(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Schema& schema);
  void checkpoint(Checkpoint& state) override {
    if (soils_) soils_->match(state);
    field_.checkpoint(state);
  }

 private:
  std::optional<SoilCard> card_;
  std::optional<SoilPatches> soils_;
  HeightField field_;
  Surface surface_;  // of the last call of surface()
};

}  // namespace furrow::coupling

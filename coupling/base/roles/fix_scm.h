// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Base of the fix whose ground is a height field, as the other jobs see it: contacts press on it,
/// scm/history records it.

#include <optional>

#include "coupling/base/furrow_fix.h"
#include "furrow/io/inputs/soil_card_file.h"
#include "furrow/scm/height_field.h"
#include "furrow/scm/soil.h"

namespace furrow::coupling {

class FixScm : public FurrowFix {
 public:
  static const Outputs<FixScm>& outputs();
  HeightField& field() { return field_; }
  const HeightField& field() const { return field_; }
  /// Soils of the line and of its patches; none: a surface alone, for contact/rft.
  const std::optional<SoilPatches>& soils() const { return soils_; }
  const std::optional<SoilCard>& card() const { return card_; }

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
};

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Role of a fix that accounts for a part of the work of a wheel on its ground.

#include "furrow/bodies/body.h"
#include "furrow/rig/ground_losses.h"

namespace furrow::coupling {

class LossLedger {
 public:
  virtual ~LossLedger() = default;
  /// Adds the energies that this fix accounts for since the start of the scene; nothing for the
  /// fixes of other wheels. Collective.
  virtual void add_losses(const Body& wheel, GroundLosses& losses) const = 0;
};

}  // namespace furrow::coupling

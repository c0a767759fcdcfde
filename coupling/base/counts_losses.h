// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Fixes that account for a part of the work of a wheel on its ground.

#include "bodies/body.h"
#include "rig/ground_losses.h"

namespace furrow::coupling {

class CountsLosses {
 public:
  virtual ~CountsLosses() = default;
  /// Adds the energies that this fix accounts for since the start of the scene; nothing if the fix
  /// has to do with another wheel. Collective.
  virtual void add_losses(const Body& wheel, GroundLosses& losses) const = 0;
};

}  // namespace furrow::coupling

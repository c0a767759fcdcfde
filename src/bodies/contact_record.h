// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Interface for objects that receive each force of a contact in addition to the nodal forces.

#include "furrow/core/types.h"

namespace furrow {

class ContactRecord {
 public:
  virtual ~ContactRecord() = default;
  /// A force that acts for dt [s], of this rank; in a half model that of both halves.
  /// @param point    of the surface [m]
  /// @param force    on the body [N]
  /// @param sliding  velocity of the surface over the ground there [m/s]
  virtual void add(const Vector3& point, const Vector3& force, const Vector3& sliding,
                   double dt) = 0;
};

}  // namespace furrow

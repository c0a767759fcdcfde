// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The keys that every wheel has: what moves with the axle, and where the axle is.

#include "bodies/wheel_hub.h"
#include "core/options.h"

namespace furrow {

/// Adds mass, inertia, inertia_diametral and axle.
void declare_hub(Schema& schema);

struct HubOptions {
  HubInertia inertia;
  Vector3 centre;  ///< [m] of the axle at the start
};

/// @param width [m] of the part that carries the mass: where inertia_diametral is not given, it is
///   inertia/2 + mass width^2/12, exact for any distribution of mass that is the same in every
///   plane across the axle
HubOptions read_hub(const Options& options, double width);

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Mass, inertia and position of an axle, and the keys that give them: the same for a rigid wheel
/// and for the rim of a tyre.

#include <string>

#include "furrow/core/options/options.h"
#include "furrow/core/types.h"

namespace furrow {

/// Inertia of what moves with the axle: a body of revolution.
struct HubInertia {
  double mass = 0.0;       ///< [kg]
  double axial = 0.0;      ///< [kg m^2] about the axle, C
  double diametral = 0.0;  ///< [kg m^2] about any line across the axle through the centre, A
};

struct HubParameters {
  HubInertia inertia;
  Vector3 centre = Vector3::Zero();  ///< [m] of the axle at the start
};

/// Adds the keys mass, inertia, inertia_diametral and axle.
void declare_hub(Schema& schema);
/// Adds the key axle alone.
void declare_axle(Schema& schema);
/// Reads the key axle [m].
Vector3 read_axle(const Options& options);

/// Reads these keys. Where inertia_diametral is not given it is C/2 + m width^2/12, exact for any
/// distribution of mass that is the same in every plane across the axle.
/// @param width [m] over which the mass is spread along the axle
HubParameters read_hub(const Options& options, double width);

/// @param where names the wheel in errors: "fix wheel/rigid"
/// @throws InputError for a mass or inertia that is not positive, inertias that no body has, or a
/// position that is not finite
void check(const HubParameters& hub, const std::string& where);

}  // namespace furrow

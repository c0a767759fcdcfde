// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Contact of a body with the values that the ground gives (material/ground_contact.h).

#include <optional>
#include <string>

#include "furrow/core/options/options.h"
#include "coupling/base/fix_body.h"
#include "coupling/base/roles/ground.h"
#include "furrow/material/ground_contact.h"

namespace furrow::coupling {

/// The key `body_material`. @param others  materials in addition to those that a ground can name
void declare_body_material(Schema& schema, const std::vector<std::string>& others = {});
/// Material by the key; without it rubber for a tyre, steel for all other bodies.
std::string body_material(const Options& options, const FixBody& body);

/// Warns of a slip length in centimetres or kilometres in the place of metres.
void warn_of_slip_length(LAMMPS_NS::LAMMPS& lammps, const Options& options);

/// Friction and slip length of a contact, from the ground where a line does not give them. Prints
/// the values; warns where the ground knows nothing, or has a shear limit that the law does not
/// use.
/// @param without  values in effect without those of the ground
/// @param consequence  of these values, for the warning
BodyContact contact_with(LAMMPS_NS::LAMMPS& lammps, const Options& options, const FixBody& body,
                         const std::string& material, const Terrain& terrain,
                         const BodyContact& without, const std::string& consequence);

/// Puts the friction and slip length in effect into the settings of a contact.
void put_effective(std::vector<std::pair<std::string, std::string>>& settings, double friction,
                   double slip_length);

}  // namespace furrow::coupling

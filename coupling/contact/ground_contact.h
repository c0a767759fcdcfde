// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Contact of a body with what the ground says about it (material/ground_contact.h).

#include <optional>
#include <string>

#include "core/options.h"
#include "coupling/base/fix_body.h"
#include "material/ground_contact.h"

namespace furrow::coupling {

/// The key `body_material`. @param others  materials in addition to those that a ground can name
void declare_body_material(Schema& schema, const std::vector<std::string>& others = {});
/// Of the key; without it rubber for a tyre, steel for all other bodies.
std::string body_material(const Options& options, const FixBody& body);

/// Centimetres for metres, or kilometres.
void warn_of_slip_length(LAMMPS_NS::LAMMPS& lammps, const Options& options);

/// What holds for the keys friction and slip_length that a line does not give. Prints what it took;
/// warns where the ground knows nothing.
/// @param ground  its name for messages
/// @param without  what holds then
/// @param consequence  of what holds without, for the warning
BodyContact contact_with(LAMMPS_NS::LAMMPS& lammps, const Options& options, const FixBody& body,
                         const std::string& material, const std::string& ground,
                         const GroundContact& known, const BodyContact& without,
                         const std::string& consequence);

/// Puts the friction that holds into the settings of a contact, wherever it comes from.
void put_effective(std::vector<std::pair<std::string, std::string>>& settings, double friction,
                   double slip_length);

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The contact laws: how a surface and the particles that touch it are kept apart.
///
/// A law is a class like PenaltyLaw:
///   static constexpr const char* name, *meaning;   // for keyword 'enforcement' and its page
///   explicit Law(const ContactParameters&);
///   // to the step of this terrain; @throws InputError when it cannot; `where`: the contact
///   void fit(const TerrainParameters&, const std::string& where);
///   // for every touching particle in each step: the stiffness of its springs
///   void update_stiffness(const ParticleGroup&, std::size_t particle, ContactHistory&) const;
///   // for every touching particle in each step of dt: force of the surface on the ground [N]; the
///   // energy that the contact takes is added to the losses
///   Vector3 force(const ContactMotion&, double dt, ContactHistory&, ContactLosses&) const;
/// A new law is one file and one row here. The law is chosen once a step: calls for a particle are
/// direct.

#include <string>
#include <variant>
#include <vector>

#include "mpm/contact/contact_parameters.h"
#include "mpm/contact/impulse_law.h"
#include "mpm/contact/penalty_law.h"

namespace furrow {

using ContactLaw = std::variant<PenaltyLaw,  //
                                ImpulseLaw>;

std::vector<std::string> contact_law_names();
/// Meanings of the laws, in the order of their names.
std::string contact_law_meanings();
/// @param where  names the contact in errors
/// @throws InputError for an enforcement that no law has
ContactLaw make_contact_law(const ContactParameters& parameters, const std::string& where);

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The contact laws: how a surface and the particles that touch it are kept apart.
///
/// A law is a class like PenaltyLaw, built from ContactParameters.
/// - name and meaning are shown by keyword 'enforcement' and its page.
/// - fit adapts the law to the step of a terrain. It is called once, before all others, and throws
///   InputError where the law cannot be adapted.
/// - update_stiffness sets the springs of a touching particle. It is called in each step.
/// - force follows it. It returns the force of the surface on the ground at this particle [N], and
///   adds the energy that the contact takes to the losses.
///
/// A new law is one file and one row here. The law is chosen once a step: calls for a particle are
/// direct.

#include <string>
#include <variant>
#include <vector>

#include "furrow/mpm/contact/contact_parameters.h"
#include "furrow/mpm/contact/impulse_law.h"
#include "furrow/mpm/contact/penalty_law.h"

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

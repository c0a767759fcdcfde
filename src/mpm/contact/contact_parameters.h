// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The parameters of a contact between a surface and a terrain, and the keys that set them.

#include <limits>
#include <optional>
#include <string>

#include "furrow/core/options/options.h"
#include "furrow/material/ground_contact.h"

namespace furrow {

struct ContactParameters {
  std::string enforcement = "penalty";  ///< name of a contact law (contact_law.h)
  double friction = 0.3;                ///< mu of Coulomb's law; 0: smooth, infinity: rough
  /// k of [Shoop2001] eq. 26 [m]: tau = mu sigma (1 - exp(-j/k)), j the slip; 0: Coulomb's law
  double slip_length = 0.0;
  double shear_limit = std::numeric_limits<double>::infinity();  ///< on tau: adhesion [Pa]
  /// spring of a particle over (wave modulus) x (cube root of its volume); without: chosen for the
  /// ground's step (PenaltyLaw::fit)
  std::optional<double> stiffness = {};
  double damping = 0.1;  ///< of the spring with the particle's mass, of critical

  /// The keys of a contact. @param subject  names the owner in errors
  static Schema schema(const std::string& subject = "contact with ground");
  /// @param ground  friction and slip length of a frictional surface that the keys do not give
  /// @throws InputError for keys that do not go together
  static ContactParameters from(const Options& options, const BodyContact& ground = unknown());
  /// Contact with a ground of which nothing is known.
  static BodyContact unknown();
};

}  // namespace furrow

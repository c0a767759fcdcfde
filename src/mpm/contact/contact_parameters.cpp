// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/contact/contact_parameters.h"

#include <limits>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/mpm/contact/contact_law.h"

namespace furrow {

Schema ContactParameters::schema(const std::string& subject) {
  Schema schema(subject);
  schema.choice("enforcement", contact_law_names(), contact_law_meanings()).by_default("penalty");
  schema
      .choice("surface", {"frictional", "rough", "smooth"},
              "`frictional`: Coulomb; `rough`: no slip; `smooth`: no friction")
      .by_default("frictional");
  schema
      .number("friction", "", Range::non_negative(),
              "friction coefficient mu of a frictional surface; by default from the material file")
      .optional();
  schema
      .number("slip_length", "m", Range::closed(0.0, 1.0),
              "k of tau = mu sigma (1 - exp(-j/k)), j the slip distance; 0: tau = mu sigma; by "
              "default from the material file")
      .optional();
  schema
      .number("shear_limit", "Pa", Range::positive(),
              "largest shear stress tau, of clay its adhesion; by default from the material file, "
              "else none")
      .optional();
  schema
      .number("stiffness", "", Range::closed(0.01, 100.0),
              "spring stiffness of a particle over wave modulus times cube root of its volume; by "
              "default 1.6, or less where the step of the ground needs it")
      .optional();
  schema
      .number("damping", "", Range::closed(0.0, 1.0),
              "damping ratio of the contact spring with the particle's mass; 1: critical")
      .by_default(0.1);
  return schema;
}

BodyContact ContactParameters::unknown() {
  const ContactParameters p;
  BodyContact contact;
  contact.friction = p.friction;
  contact.slip_length = p.slip_length;
  return contact;
}

ContactParameters ContactParameters::from(const Options& options, const BodyContact& ground) {
  const auto value = [&](const char* key, double of_ground) {
    return options.given(key) ? options.number(key) : of_ground;
  };
  const std::string& surface = options.text("surface");
  if (surface != "frictional" && options.given("friction"))
    throw InputError(options.where("friction"), fmt::format("is given with a {} surface", surface),
                     "friction with surface frictional only");
  if (surface != "frictional" && options.given("slip_length") &&
      options.number("slip_length") > 0.0)
    throw InputError(options.where("slip_length"),
                     fmt::format("is given with a {} surface", surface),
                     "slip_length with surface frictional only", "remove 'slip_length'");
  if (surface == "smooth" && options.given("shear_limit"))
    throw InputError(options.where("shear_limit"), "is given with a smooth surface",
                     "shear_limit with surface frictional or rough", "remove 'shear_limit'");
  for (const char* key : {"stiffness", "damping"})
    if (options.text("enforcement") == "impulse" && options.given(key))
      throw InputError(options.where(key), "is given with enforcement impulse",
                       "with enforcement penalty only", fmt::format("remove '{}'", key));
  ContactParameters p;
  p.enforcement = options.text("enforcement");
  p.friction = surface == "rough"    ? std::numeric_limits<double>::infinity()
               : surface == "smooth" ? 0.0
                                     : value("friction", ground.friction);
  p.slip_length = surface == "frictional" ? value("slip_length", ground.slip_length) : 0.0;
  p.shear_limit =
      value("shear_limit", surface == "frictional" ? ground.shear_limit : p.shear_limit);
  if (options.given("stiffness")) p.stiffness = options.number("stiffness");
  p.damping = options.number("damping");
  return p;
}

}  // namespace furrow

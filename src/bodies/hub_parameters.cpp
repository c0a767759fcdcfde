// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/bodies/hub_parameters.h"

#include <cmath>

#include <fmt/format.h>

#include "furrow/core/options/check_number.h"
#include "furrow/core/error.h"

namespace furrow {

void declare_hub(Schema& schema) {
  schema.number("mass", "kg", Range::positive(),
                "mass of the rigid wheel, or of a tyre's rim and all that moves with it");
  schema.number("inertia", "kg m^2", Range::positive(),
                "moment of inertia of that mass about the axle");
  schema
      .number("inertia_diametral", "kg m^2", Range::positive(),
              "moment of inertia across the axle; by default `inertia`/2 + `mass` w^2/12, w the "
              "width or the bead spacing")
      .optional();
  declare_axle(schema);
}

void declare_axle(Schema& schema) {
  schema
      .numbers("axle", 3, "m", Range::any(),
               "x y z of the axle centre at the start; y = 0 for a half model")
      .by_default(std::vector<double>{0, 0, 0});
}

Vector3 read_axle(const Options& options) {
  return Eigen::Map<const Vector3>(options.numbers("axle").data());
}

HubParameters read_hub(const Options& options, double width) {
  HubParameters hub;
  HubInertia& inertia = hub.inertia;
  inertia.mass = options.number("mass");
  inertia.axial = options.number("inertia");
  inertia.diametral = options.has("inertia_diametral")
                          ? options.number("inertia_diametral")
                          : 0.5 * inertia.axial + inertia.mass * std::pow(width, 2) / 12.0;
  hub.centre = read_axle(options);
  return hub;
}

void check(const HubParameters& hub, const std::string& where) {
  const auto named = [&](const char* key) { return fmt::format("{}, keyword '{}'", where, key); };
  const HubInertia& inertia = hub.inertia;
  check_number(inertia.mass, Range::positive(), named("mass"), "kg");
  check_number(inertia.axial, Range::positive(), named("inertia"), "kg m^2");
  check_number(inertia.diametral, Range::positive(), named("inertia_diametral"), "kg m^2");
  if (2.0 * inertia.diametral < inertia.axial)
    throw InputError(named("inertia_diametral"), fmt::format("is {} kg m^2", inertia.diametral),
                     fmt::format("at least half of inertia, {} kg m^2", 0.5 * inertia.axial));
  if (!hub.centre.allFinite())
    throw InputError(named("axle"), "is not finite", "three numbers [m]");
}

}  // namespace furrow

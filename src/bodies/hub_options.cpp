// SPDX-License-Identifier: GPL-2.0-or-later
#include "bodies/hub_options.h"

#include <cmath>

namespace furrow {

void declare_hub(Schema& schema) {
  schema.number("mass", "kg", Range::positive(),
                "of what moves rigidly with the axle: a whole rigid wheel, or the rim of a tyre");
  schema.number("inertia", "kg m^2", Range::positive(), "its moment of inertia about the axle");
  schema
      .number("inertia_diametral", "kg m^2", Range::positive(),
              "the same across the axle; by default inertia/2 + mass w^2/12 with w the width "
              "between the sides, or the beads")
      .optional();
  schema.numbers("axle", 3, "m", Range::any(), "axle centre at the start: x y z")
      .by_default(std::vector<double>{0, 0, 0});
}

HubOptions read_hub(const Options& options, double width) {
  HubOptions hub;
  hub.inertia.mass = options.number("mass");
  hub.inertia.axial = options.number("inertia");
  hub.inertia.diametral =
      options.has("inertia_diametral")
          ? options.number("inertia_diametral")
          : 0.5 * hub.inertia.axial + hub.inertia.mass * std::pow(width, 2) / 12.0;
  const std::vector<double>& axle = options.numbers("axle");
  hub.centre = {axle[0], axle[1], axle[2]};
  return hub;
}

}  // namespace furrow

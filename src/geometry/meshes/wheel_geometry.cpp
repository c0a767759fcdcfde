// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/meshes/wheel_geometry.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/options/check_number.h"
#include "furrow/core/error.h"

namespace furrow {

namespace {

constexpr double largest_skew = radians(60);
// Diameter over width: of rollers and bicycles 0.3 and 30
const Range usual_shapes = Range::closed(0.05, 100.0);

void check_grousers(const WheelGeometry& wheel, const std::string& where) {
  const Grousers& bars = wheel.grousers;
  if (bars.number < 0)
    throw InputError(where, fmt::format("has {} grousers", bars.number), "an integer >= 0");
  if (bars.number == 0) return;
  check_number(bars.height, Range::positive(), where + ", grouser_height", "m");
  check_number(bars.thickness, Range::positive(), where + ", grouser_thickness", "m");
  if (!(std::abs(bars.angle) <= largest_skew))
    throw InputError(where, fmt::format("has grouser_angle {} degrees", degrees(bars.angle)),
                     "-60 to 60 degrees");
  if (!(wheel.tread_width() > 0.0))
    throw InputError(
        where, "has grousers but no flat tread to carry them",
        fmt::format("grousers on a shoulder below half the width, {} m", 0.5 * wheel.width),
        "reduce the shoulder");
  const double along = bars.thickness / std::cos(bars.angle);
  const double pitch = 2.0 * pi * wheel.radius() / bars.number;
  if (along >= pitch || along >= wheel.radius())
    throw InputError(where,
                     fmt::format("has {} grousers that overlap: each takes {:.4g} m of the "
                                 "circumference, their pitch is {:.4g} m",
                                 bars.number, along, pitch),
                     "bars narrower than their pitch and than the radius",
                     "reduce their number, thickness or angle");
}

}  // namespace

void check(const WheelGeometry& wheel, const std::string& where) {
  check_number(wheel.diameter, Range::positive(), where + ", diameter", "m");
  check_number(wheel.width, Range::positive(), where + ", width", "m");
  if (const double ratio = wheel.diameter / wheel.width; !usual_shapes.contains(ratio))
    throw InputError(
        where,
        fmt::format("has a diameter of {:g} m and a width of {:g} m: a ratio of {:.3g}",
                    wheel.diameter, wheel.width, ratio),
        fmt::format("a ratio of {:g} to {:g}", usual_shapes.lower, usual_shapes.upper),
        "give both in m, not in mm or cm");
  if (!(wheel.shoulder >= 0.0 && wheel.shoulder <= 0.5 * wheel.width &&
        wheel.shoulder < wheel.radius()))
    throw InputError(where, fmt::format("has shoulder {} m", wheel.shoulder),
                     fmt::format("0 to half the width, {} m, and below the radius, {} m",
                                 0.5 * wheel.width, wheel.radius()));
  if (wheel.segments < 12)
    throw InputError(where, fmt::format("has {} segments", wheel.segments), "an integer >= 12");
  if (!(std::isfinite(wheel.element_size) && wheel.element_size >= 0.0))
    throw InputError(where, fmt::format("has element_size {} m", wheel.element_size),
                     "a number > 0, or 0 for one and a half facets");
  check_grousers(wheel, where);
}

// Support function of the Minkowski sum of a cylinder (radius R - s, half width w/2 - s) and a ball
// of radius s.
double WheelGeometry::depth_below_centre(const Vector3& axle) const {
  const double up = std::min(1.0, std::abs(axle.z()));
  return (radius() - shoulder) * std::sqrt(1.0 - up * up) + (0.5 * width - shoulder) * up +
         shoulder;
}

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/tyre_parameters.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/options/check_number.h"
#include "furrow/core/error.h"
#include "furrow/tyre/sidewall/arc.h"

namespace furrow {

namespace {

constexpr std::size_t min_segments = 4, max_segments = 1000;
// Length of a sidewall over its chord: a circle that is a sixth open, more than any tyre's.
constexpr double max_slack = 3.0;

void need_positive(double value, const std::string& where, const std::string& name,
                   const std::string& unit) {
  check_number(value, Range::positive(), fmt::format("{}, {}", where, name), unit);
}

/// Checks everything that does not concern the tread or a sidewall alone.
void check_section(const TyreParameters& tyre, const std::string& where) {
  const Vector2 chord = tyre.sidewall_chord();
  const double distance = chord.norm();
  const double length = tyre.sidewall.length;
  need(distance < length, where,
       fmt::format("the sidewall is stretched past its length: bead and tread edge are {:.4g} m "
                   "apart, its length is {:.4g} m",
                   distance, length),
       "a sidewall longer than that",
       "mind whether length, radii and widths belong to the same points");
  need(
      length <= max_slack * distance, where,
      fmt::format("bead and tread edge are {:.4g} m apart, and the sidewall between them is {:.4g} "
                  "m long",
                  distance, length),
      fmt::format("a sidewall of at most {:.4g} m, {:g} times as long", max_slack * distance,
                  max_slack),
      "mind the units: metres");
  // Inflated, a sidewall is near an arc, which leaves the bead at this angle from the axial
  // direction.
  const double leaves = std::atan2(chord[1], chord[0]) - arc_half_angle(distance / length);
  need(leaves < 0.5 * pi, where,
       fmt::format("the rim is wider than the tyre: with its beads {:.4g} m apart the inflated "
                   "sidewalls lean inwards from the "
                   "beads on",
                   tyre.bead_spacing),
       "a bead_spacing below the section width",
       "a wider tread, a longer sidewall, or a narrower rim");
}

/// @param bead_radius [m]
void check(const TreadParameters& tread, double bead_radius, const std::string& where) {
  need_positive(tread.radius, where, "the tread's radius", "m");
  need_positive(tread.half_width, where, "the tread's half_width", "m");
  need(tread.radius > bead_radius, where,
       fmt::format("the tread, {:.4g} m from the axle, lies inside the rim ({:.4g} m)",
                   tread.radius, bead_radius),
       "a tread outside the rim");
  const double height = tread.radius - bead_radius;
  need(tread.crown >= 0.0 && tread.crown < height, where,
       fmt::format("the tread's crown is {} m", tread.crown),
       fmt::format("from 0 to below the section height, {:.4g} m", height));
  need_positive(tread.thickness, where, "the tread's thickness", "m");
  need_positive(tread.E1, where, "the tread's E1", "Pa");
  need_positive(tread.E2, where, "the tread's E2", "Pa");
  need_positive(tread.G12, where, "the tread's G12", "Pa");
  need_positive(tread.areal_mass, where, "the tread's areal_mass", "kg/m2");
  need(tread.nu12 * tread.nu12 * tread.E2 < tread.E1, where,
       fmt::format("the tread's nu12 = {} makes its stiffness indefinite", tread.nu12),
       fmt::format("below sqrt(E1/E2) = {:.4g} in size", std::sqrt(tread.E1 / tread.E2)));
}

}  // namespace

void check(const SidewallParameters& sidewall, const std::string& where) {
  need_positive(sidewall.length, where, "length", "m");
  const std::size_t n = sidewall.segments();
  need(n >= min_segments && n <= max_segments, where,
       fmt::format("has {} values of bending", n - 1),
       fmt::format("{} to {}, one for each hinge between segments", min_segments - 1,
                   max_segments - 1));
  need(
      sidewall.curvature.size() == n - 1, where,
      fmt::format("has {} values of curvature for {} of bending", sidewall.curvature.size(), n - 1),
      "as many, one for each hinge");
  const double L = sidewall.length / static_cast<double>(n);
  for (const double bending : sidewall.bending)
    need(bending >= 0.0 && std::isfinite(bending), where, fmt::format("bending is {} N m", bending),
         "numbers >= 0");
  for (const double curvature : sidewall.curvature)
    need(std::abs(curvature) * L < pi, where,
         fmt::format("curvature {} 1/m folds a hinge", curvature),
         fmt::format("below pi/L = {:.3g} 1/m", pi / L));
  for (const double angle : {sidewall.rim_angle, sidewall.tread_angle})
    need(std::abs(angle) <= pi, where,
         fmt::format("an attachment angle is {} degrees", degrees(angle)),
         "from -180 to 180 degrees");
  for (const double stiffness : {sidewall.rim_stiffness, sidewall.tread_stiffness})
    need(stiffness >= 0.0 && std::isfinite(stiffness), where,
         fmt::format("the stiffness of an end spring is {} N m/rad per m", stiffness),
         "a number >= 0");
  need(sidewall.bead_width > 0.0 && std::isfinite(sidewall.bead_width) && sidewall.taper >= 0.0 &&
           std::isfinite(sidewall.taper),
       where, fmt::format("the strip's width is {} + {} r", sidewall.bead_width, sidewall.taper),
       "numbers > 0 and >= 0");
}

void check(const TyreParameters& tyre, const std::string& where) {
  check_number(tyre.pressure, Range::closed(0.0, largest_inflation), where + ", pressure", "Pa");
  need_positive(tyre.bead_radius, where, "bead_radius", "m");
  need_positive(tyre.bead_spacing, where, "bead_spacing", "m");
  need(tyre.link.allFinite(), where, "the link is not finite", "two numbers [m]");
  check(tyre.tread, tyre.bead_radius, where);
  check(tyre.sidewall, where);
  check_section(tyre, where);
}

}  // namespace furrow

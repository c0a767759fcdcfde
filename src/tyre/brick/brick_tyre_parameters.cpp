// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/brick/brick_tyre_parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "furrow/core/options/check_number.h"
#include "furrow/core/error.h"
#include "furrow/tyre/brick/section_curve.h"

namespace furrow {

namespace {

constexpr double minimum_base = 1e-3;      // [m] of rubber under a void
constexpr double minimum_distance = 2e-3;  // [m] between places where the section changes
constexpr double outline_slack =
    2e-3;  // [m] allowed distance of the last zone from the end of the outline
constexpr double outline_wave = 1e-4;  // [m] allowed rise of the outline towards the bead
constexpr int outline_samples = 500;

/// Few points make a curve with waves, of which the belts would have a valley all round.
void check_fall(const SectionCurve& curve, const std::string& where) {
  double least = curve.point(0.0)[1];
  for (int k = 1; k <= outline_samples; ++k) {
    const Vector2 at = curve.point(curve.length() * k / outline_samples);
    need(at[1] <= least + outline_wave, where,
         fmt::format("the smooth curve through the carcass's points rises from radius {:.5g} to "
                     "{:.5g} m at axial = {:.3g} m, between them",
                     least, at[1], at[0]),
         "a radius that falls from the mid-plane to the bead; give more points near there");
    least = std::min(least, at[1]);
  }
}

void check(const CarcassParameters& carcass, const std::string& where) {
  const std::size_t n = carcass.axial.size();
  need(n >= 4 && carcass.radius.size() == n, where,
       fmt::format("the carcass's outline has {} values of axial and {} of radius", n,
                   carcass.radius.size()),
       "as many of both, four at least");
  need(carcass.axial.front() == 0.0, where,
       fmt::format("the carcass's outline begins at axial = {} m", carcass.axial.front()),
       "0, the mid-plane");
  for (std::size_t i = 1; i < n; ++i) {
    need(carcass.axial[i] > 0.0, where,
         fmt::format("a point of the carcass's outline has axial = {} m", carcass.axial[i]),
         "numbers > 0 after the first");
    need(carcass.radius[i] < carcass.radius[i - 1], where,
         fmt::format("the carcass's outline goes from radius {} to {} m", carcass.radius[i - 1],
                     carcass.radius[i]),
         "radii that fall from the mid-plane to the bead");
  }
  need(!carcass.zones.empty(), where, "the carcass has no zones", "one at least");
  const SectionCurve curve(carcass.axial, carcass.radius);
  check_fall(curve, where);
  const double length = curve.length();
  double last = 0.0;
  for (const CarcassZone& zone : carcass.zones) {
    need(zone.end > last, where,
         fmt::format("a zone of the carcass ends at {} m, where the one before ends at {} m",
                     zone.end, last),
         "ends that rise from the mid-plane to the bead");
    last = zone.end;
    ShellSection(zone.wall, zone.areal_mass);  // refuses what is not positive
  }
  need(
      std::abs(last - length) <= outline_slack, where,
      fmt::format("the last zone of the carcass ends at {:.4g} m, and the outline is {:.4g} m long",
                  last, length),
      fmt::format("an end within {:g} m of that length", outline_slack));
}

void check(const TreadVoid& cut, const TreadCapParameters& tread, const std::string& where) {
  const std::string name = fmt::format("the void from {:g} to {:g} m", cut.from, cut.to);
  need(cut.from >= 0.0 && cut.to > cut.from && cut.to < tread.end(), where,
       name + " is not on the tread", fmt::format("0 <= from < to < {:g} m", tread.end()));
  check_number(cut.depth, Range::positive(), fmt::format("{}, depth of {}", where, name), "m");
  const double thickness = std::min(tread.thickness_at(cut.from), tread.thickness_at(cut.to));
  need(cut.depth <= thickness - minimum_base, where,
       fmt::format("{} is {:g} m deep", name, cut.depth),
       fmt::format("at most {:.4g} m, which leaves {:g} m of rubber under it",
                   thickness - minimum_base, minimum_base));
  need(cut.pitches == 0 || (cut.pitches >= 3 && cut.share > 0.0 && cut.share < 1.0), where,
       fmt::format("{} has {} pitches and a share of {:g}", name, cut.pitches, cut.share),
       "0 for a groove, or 3 pitches at least with a share between 0 and 1");
}

void check(const TreadCapParameters& tread, double length, const std::string& where) {
  const std::size_t n = tread.at.size();
  need(n >= 2 && tread.thickness.size() == n, where,
       fmt::format("the tread has {} values of at and {} of thickness", n, tread.thickness.size()),
       "as many of both, two at least");
  need(tread.at.front() == 0.0 && tread.end() < length, where,
       fmt::format("the tread goes from {:g} to {:g} m", tread.at.front(), tread.end()),
       fmt::format("from 0 to less than the outline's length, {:.4g} m", length));
  for (std::size_t i = 0; i < n; ++i) {
    need(i == 0 || tread.at[i] > tread.at[i - 1], where, "the tread's values of at do not rise",
         "values that rise from 0");
    need(i + 1 == n ? tread.thickness[i] == 0.0 : tread.thickness[i] > minimum_base, where,
         fmt::format("the tread's thickness at {:g} m is {:g} m", tread.at[i], tread.thickness[i]),
         fmt::format("more than {:g} m, and 0 at its end", minimum_base));
  }
  need(tread.layers >= 1 && tread.layers <= 10 && tread.rib_layers >= 1 && tread.rib_layers <= 10,
       where,
       fmt::format("the tread has {} layers and {} rib_layers", tread.layers, tread.rib_layers),
       "1 to 10");
  check_number(tread.rubber.law.shear, Range::positive(), where + ", the tread's C10", "Pa");
  check_number(tread.rubber.density, Range::positive(), where + ", the tread's density", "kg/m3");
  double last = -1.0;
  for (const TreadVoid& cut : tread.voids) {
    check(cut, tread, where);
    need(
        cut.from > last, where,
        fmt::format("a void begins at {:g} m, before the end of another at {:g} m", cut.from, last),
        "voids in order from the mid-plane on, with rubber between");
    last = cut.to;
  }
}

/// Places of change that nearly meet would make slivers, whose step is tiny.
void check_places(const BrickTyreParameters& tyre, double length, const std::string& where) {
  double last = 0.0;
  for (const double place : places_of_change(tyre, length)) {
    need(place - last <= same_place || place - last >= minimum_distance, where,
         fmt::format("the section changes at {:g} m and again at {:g} m: a zone, a void, or the "
                     "tread's thickness",
                     last, place),
         fmt::format("places at least {:g} m apart, or the same", minimum_distance));
    last = place;
  }
}

}  // namespace

std::vector<double> places_of_change(const BrickTyreParameters& tyre, double length) {
  std::vector<double> places = {0.0, length};
  places.insert(places.end(), tyre.tread.at.begin() + 1, tyre.tread.at.end());
  for (const TreadVoid& cut : tyre.tread.voids) places.insert(places.end(), {cut.from, cut.to});
  for (std::size_t i = 0; i + 1 < tyre.carcass.zones.size(); ++i)
    places.push_back(tyre.carcass.zones[i].end);
  std::sort(places.begin(), places.end());
  return places;
}

std::string wrinkling(const BrickTyreParameters& tyre) {
  if (tyre.carcass.cords) return {};
  const SectionCurve curve(tyre.carcass.axial, tyre.carcass.radius);
  const double ds = curve.length() / outline_samples;
  int widest = 1;
  for (int k = 2; k < outline_samples; ++k)
    if (curve.point(k * ds)[0] > curve.point(widest * ds)[0]) widest = k;
  if (widest == outline_samples - 1) return {};  // at the bead
  const double s = widest * ds;
  const double radius = 2.0 * ds / (curve.normal(s + ds) - curve.normal(s - ds)).norm();
  const double tension = tyre.pressure * radius;
  const auto zone = std::find_if(tyre.carcass.zones.begin(), tyre.carcass.zones.end() - 1,
                                 [s](const CarcassZone& of) { return of.end > s; });
  if (tension <= 4.0 * zone->wall.shear) return {};
  return fmt::format(
      "at {:g} kPa the tension across the carcass, where it is widest, is {:.3g} N/m, more than "
      "four times its shear stiffness of {:.3g} N/m: a fine mesh wrinkles there; give 'cords: yes' "
      "in the tyre file's section carcass, or 'shear' of at least {:.3g} N/m",
      1e-3 * tyre.pressure, tension, zone->wall.shear, 0.25 * tension);
}

double TreadCapParameters::thickness_at(double s) const {
  const auto next = std::upper_bound(at.begin() + 1, at.end() - 1, s);
  const auto i = static_cast<std::size_t>(next - at.begin());
  const double share = std::clamp((s - at[i - 1]) / (at[i] - at[i - 1]), 0.0, 1.0);
  return (1.0 - share) * thickness[i - 1] + share * thickness[i];
}

double TreadCapParameters::narrowest_void(double radius) const {
  double narrowest = std::numeric_limits<double>::infinity();
  for (const TreadVoid& cut : voids) {
    narrowest = std::min(narrowest, cut.to - cut.from);
    if (cut.pitches > 0)
      narrowest = std::min(narrowest, cut.share * 2.0 * pi * radius / cut.pitches);
  }
  return narrowest;
}

double TreadCapParameters::narrowest_rib(double radius) const {
  double narrowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < voids.size(); ++i) {
    const TreadVoid& cut = voids[i];
    if (cut.pitches > 0) {
      narrowest = std::min(narrowest, (1.0 - cut.share) * 2.0 * pi * radius / cut.pitches);
      continue;
    }
    if (i == 0 && cut.from > 0.0) narrowest = std::min(narrowest, 2.0 * cut.from);
    if (i + 1 < voids.size()) narrowest = std::min(narrowest, voids[i + 1].from - cut.to);
  }
  return narrowest;
}

double TreadCapParameters::depth_at(double s) const {
  const TreadVoid* before = nullptr;
  for (const TreadVoid& cut : voids) {
    if (s < cut.from) {
      if (!before) return cut.depth;
      const double share = (s - before->to) / (cut.from - before->to);
      return (1.0 - share) * before->depth + share * cut.depth;
    }
    if (s <= cut.to) return cut.depth;
    before = &cut;
  }
  return before ? before->depth : 0.0;
}

void check(const BrickTyreParameters& tyre, const std::string& where) {
  check_number(tyre.pressure, Range::closed(0.0, largest_inflation), where + ", pressure", "Pa");
  check(tyre.carcass, where);
  const double length = SectionCurve(tyre.carcass.axial, tyre.carcass.radius).length();
  check(tyre.tread, length, where);
  check_places(tyre, length, where);
}

}  // namespace furrow

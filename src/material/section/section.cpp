// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/section/section.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

const Range abaqus_ratio = Range::closed(0.778, 1.0), smooth_ratio = Range::closed(0.6, 1.0);

/// The largest root of (1 - w) g^3 - g = w c, by the cosine of a third of an angle.
double largest_root(double w, double c) {
  const double scale = std::sqrt(3.0 * (1.0 - w));
  return 2.0 / scale * std::cos(std::acos(std::clamp(1.5 * w * scale * c, -1.0, 1.0)) / 3.0);
}

}  // namespace

void declare_section(Schema& law) {
  law.number("K", "", smooth_ratio,
             "flow stress ratio, triaxial extension to compression; section abaqus: from 0.778 on")
      .by_default(1.0);
  law.choice(
         "section", {"abaqus", "matsuoka_nakai"},
         "between compression and extension: [Shoop2001] eq 12, or that of Matsuoka-Nakai's and "
         "Lade-Duncan's cones")
      .by_default("abaqus");
}

SectionParameters make_section(const Options& law) {
  SectionParameters section;
  const double K = law.number("K");
  const bool smooth = law.text("section") == "matsuoka_nakai";
  if (!smooth && !abaqus_ratio.contains(K))
    throw InputError(law.where("K"), fmt::format("is {:g}: the section would not be convex", K),
                     fmt::format("a number {} for section abaqus", abaqus_ratio.text()),
                     "take section matsuoka_nakai");
  section.K = K;
  if (K == 1.0) return section;
  section.kind = smooth ? SectionParameters::Kind::matsuoka_nakai : SectionParameters::Kind::abaqus;
  section.w = (1.0 - K * K) / (1.0 + K * K * K);
  return section;
}

double yield_measure(const Invariants& stress, const SectionParameters& section) {
  if (section.kind == SectionParameters::Kind::matsuoka_nakai)
    return stress.q * largest_root(section.w, stress.cos_3t);
  return yield_measure(stress, section.K);
}

}  // namespace furrow

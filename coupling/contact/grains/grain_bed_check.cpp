// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/grains/grain_bed_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "atom.h"
#include "furrow/core/communicator.h"
#include "coupling/base/loads/snow_pairs.h"
#include "coupling/liggghts/data/global_properties.h"
#include "coupling/liggghts/styles/script.h"
#include "domain.h"

namespace furrow::coupling {

namespace {

constexpr long every = 200;  // steps between checks
// Least contact area over the squared mean grain diameter: on a smaller one a handful of grains
// carries no pressure
constexpr double min_area = 9.0;

}  // namespace

void GrainBedCheck::warn(bool& done, const std::string& text) {
  if (done) return;
  done = true;
  coupling::warn(lammps_, fmt::format("{}: {}", where_, text));
}

void GrainBedCheck::start(const Body& body, const Body* terrain) {
  const LAMMPS_NS::Atom& atom = *lammps_.atom;
  const Communicator ranks(&lammps_.world);
  double sums[3] = {0.0, 0.0, 0.0};  // diameters, densities, count
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (int i = 0; i < atom.nlocal; ++i) {
    sums[0] += 2.0 * atom.radius[i];
    sums[1] += atom.density[i];
    sums[2] += 1.0;
    lowest = std::min(lowest, atom.x[i][1] - atom.radius[i]);
    highest = std::max(highest, atom.x[i][1] + atom.radius[i]);
  }
  ranks.sum(sums, 3);
  lowest = -ranks.max(-lowest);
  highest = ranks.max(highest);
  steps_ = 0;
  warned_overlap_ = warned_inertia_ = false;
  if (sums[2] < GrainBedLimits::min_grains) return;
  mean_diameter_ = sums[0] / sums[2];
  density_ = sums[1] / sums[2];
  choose_overlap_limit();
  if (&body == terrain) return;

  if (terrain) {
    const auto [from, to] = terrain->surface().bounds();
    lowest = std::min(lowest, from.y());
    highest = std::max(highest, to.y());
  }
  const auto [lower, upper] = body.surface().bounds();
  const double width = upper[1] - lower[1],
               bed = lammps_.domain->yperiodic ? lammps_.domain->prd[1] : highest - lowest;
  bool once = false, once_more = false;
  if (width < GrainBedLimits::grains_per_width * mean_diameter_)
    warn(once, fmt::format("the body is {:.3g} grains wide (recommended: at least {:g}); use "
                           "smaller grains, or compare two sizes",
                           width / mean_diameter_, GrainBedLimits::grains_per_width));
  if (bed < GrainBedLimits::bed_widths * width)
    warn(once_more, fmt::format("the bed is {:.3g} bodies wide (recommended: at least {:g}); its "
                                "walls confine the ground",
                                bed / width, GrainBedLimits::bed_widths));
}

void GrainBedCheck::choose_overlap_limit() {
  if (grains_are_snow(lammps_))
    overlap_limit_ = GrainBedLimits::snow_overlap;
  else if (property_of_types(lammps_, "youngsModulus"))
    overlap_limit_ = GrainBedLimits::overlap;
  else
    overlap_limit_ = std::numeric_limits<double>::infinity();
}

/// Overlaps of Hertz contacts go with E^(-2/3) under one force.
std::string GrainBedCheck::overlap_remedy(double deepest) const {
  if (grains_are_snow(lammps_))
    return "the snow is crushed to ice: lower the load, or raise snowDenseStrength";
  return fmt::format(
      "the grains are too soft for this load: make the bed with a youngsModulus {:.1f} times as "
      "large, or by 'young auto' with a higher pressure (command bed)",
      std::ceil(10.0 * std::pow(deepest / overlap_limit_, 1.5)) / 10.0);
}

void GrainBedCheck::contact(double overlap, double radius, const Vector3& point,
                            const Vector3& force) {
  if (mean_diameter_ == 0.0 || steps_ % every != 0) return;
  if (!looks_) {
    looks_ = true;
    lower_ = upper_ = point;
  }
  lower_ = lower_.cwiseMin(point);
  upper_ = upper_.cwiseMax(point);
  deepest_ = std::max(deepest_, overlap / (2.0 * radius));
  force_ += force;
}

void GrainBedCheck::finish_step(const Surface& surface) {
  if (mean_diameter_ == 0.0 || steps_++ % every != 0) return;
  const Communicator ranks(&lammps_.world);
  const double infinity = std::numeric_limits<double>::infinity();
  double extent[2];
  for (int k = 0; k < 2; ++k)
    extent[k] =
        ranks.max(looks_ ? upper_[k] : -infinity) + ranks.max(looks_ ? -lower_[k] : -infinity);
  const double deepest = ranks.max(deepest_);
  double sum[3] = {force_[0], force_[1], force_[2]};
  ranks.sum(sum, 3);
  deepest_ = 0.0;
  force_.setZero();
  looks_ = false;

  if (deepest > overlap_limit_)
    warn(warned_overlap_,
         fmt::format("a grain overlaps the body by {:.3g} of its diameter (recommended: at most "
                     "{:g}); {}",
                     deepest, overlap_limit_, overlap_remedy(deepest)));
  const double area = extent[0] * extent[1];
  const double force = std::abs(sum[2]);
  if (!(area > min_area * mean_diameter_ * mean_diameter_) || !(force > 0.0)) return;
  const double speed = surface.v.rowwise().mean().norm();
  const double number =
      speed / std::sqrt(area) * mean_diameter_ * std::sqrt(density_ * area / force);
  if (number > GrainBedLimits::inertial_number)
    warn(warned_inertia_, fmt::format("the inertial number under the body is {:.3g} (shown to be "
                                      "without influence: up to {:g}); the motion is "
                                      "not slow for these grains: compare with a slower run",
                                      number, GrainBedLimits::inertial_number));
}

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/checks/ground_level_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "atom.h"
#include "core/communicator.h"
#include "core/error.h"
#include "coupling/base/fix_coupled_system.h"
#include "coupling/liggghts/fixes_of.h"
#include "coupling/checks/driven_bodies.h"
#include "coupling/checks/touch_check.h"
#include "coupling/contact/fix_contact_continuum.h"
#include "coupling/contact/fix_contact_plane.h"
#include "coupling/terrain/fix_terrain_continuum.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr double level_tolerance = 1e-3;  // of the body's size, on a continuum or a plane
// Of the largest diameter, on grains: a bed's level may be that of its middles, of its highest
// grains or a mean, and a few grains may stick out.
constexpr double grain_tolerance = 3.0;

/// The level of something under a body, and how well it is known.
struct Level {
  double z;          // [m]
  double tolerance;  // [m]
  std::string what;
};

/// z of the highest grain within the body's outline from above, of all ranks.
std::optional<Level> level_of_grains(const LAMMPS_NS::LAMMPS& lammps, const Body& body) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  const auto [lower, upper] = body.surface().bounds();
  constexpr double none = -std::numeric_limits<double>::infinity();
  double top = none, largest = 0.0;
  for (int i = 0; i < atom.nlocal; ++i) {
    const double* x = atom.x[i];
    if (x[0] < lower[0] || x[0] > upper[0] || x[1] < lower[1] || x[1] > upper[1]) continue;
    top = std::max(top, x[2] + atom.radius[i]);
    largest = std::max(largest, 2.0 * atom.radius[i]);
  }
  const Communicator ranks(&lammps.world);
  top = ranks.max(top);
  largest = ranks.max(largest);
  if (top == none) return std::nullopt;
  return Level{top, grain_tolerance * largest, "the highest grain under it"};
}

std::vector<Level> levels_under(const LAMMPS_NS::LAMMPS& lammps, const FixBody& fix, double size) {
  std::vector<Level> levels;
  for (auto* contact : fixes_of<FixContactContinuum>(*lammps.modify))
    if (&contact->body_fix() == &fix)
      levels.push_back({contact->terrain_fix().terrain().parameters().surface,
                        level_tolerance * size,
                        fmt::format("the surface of terrain '{}'", contact->terrain_fix().id)});
  for (auto* contact : fixes_of<FixContactPlane>(*lammps.modify))
    if (&contact->body_fix() == &fix)
      levels.push_back({contact->options().number("level"), level_tolerance * size,
                        fmt::format("the level of fix contact/plane '{}'", contact->id)});
  if (touches_grains(lammps, fix))
    if (const auto grains = level_of_grains(lammps, fix.body())) levels.push_back(*grains);
  return levels;
}

/// @param height of the body: lowest and highest z
void check_height(const FixBody& body, const Level& level, const std::pair<double, double>& height,
                  double size, const Warn& warn) {
  const double gap = height.first - level.z;
  if (height.second < level.z)
    warn(
        fmt::format("'{}' lies below the ground and cannot press on it: it reaches up to z = "
                    "{:.4g} m, and {} is at z = {:.4g} m; let it start above",
                    body.id, height.second, level.what, level.z));
  else if (gap > size)
    warn(
        fmt::format("'{}' starts {:.4g} m above the ground, more than its own size: it may not "
                    "come down in time; let it start just above z = {:.4g} m",
                    body.id, gap, level.z));
}

void check_level(const LAMMPS_NS::LAMMPS& lammps, const DrivenBody& datum, const Warn& warn) {
  const double given = datum.options.number("ground_level");
  const auto [lower, upper] = datum.body.body().surface().bounds();
  const double size = (upper - lower).maxCoeff();
  const std::vector<Level> levels = levels_under(lammps, datum.body, size);
  const auto excess = [&](const Level& level) {
    return std::abs(given - level.z) - level.tolerance;
  };
  const auto nearest =
      std::min_element(levels.begin(), levels.end(),
                       [&](const Level& a, const Level& b) { return excess(a) < excess(b); });
  if (nearest == levels.end()) {
    if (touches_grains(lammps, datum.body) && lammps.atom->natoms > 0)
      warn(fmt::format("'{}' does not stand over the grains: none lies between its ends and sides",
                       datum.body.id));
    return;
  }
  check_height(datum.body, *nearest, {lower[2], upper[2]}, size, warn);
  if (excess(*nearest) <= 0.0) return;
  const std::string problem =
      fmt::format("is {:.6g} m, and {} is at z = {:.6g} m", given, nearest->what, nearest->z);
  const std::string remedy =
      fmt::format("sinkages count from it; write 'ground_level {:.6g}'", nearest->z);
  if (excess(*nearest) > size)
    throw InputError(datum.options.where("ground_level"), problem,
                     fmt::format("the level of the ground, at least within {:.3g} m, the size of "
                                 "the body",
                                 size),
                     remedy);
  warn(fmt::format("{} {}; {}", datum.options.where("ground_level"), problem, remedy));
}

}  // namespace

void check_ground_levels(LAMMPS_NS::LAMMPS& lammps, const Warn& warn) {
  const double now = FixCoupledSystem::of(lammps).time(), step = lammps.update->dt;
  const double end = now + step * lammps.update->nsteps;
  for (const DrivenBody& datum : driven_bodies(*lammps.modify)) {
    const double start = datum.options.number("start");
    if (now <= start + 0.5 * step && end > start + 0.5 * step) check_level(lammps, datum, warn);
  }
}

}  // namespace furrow::coupling

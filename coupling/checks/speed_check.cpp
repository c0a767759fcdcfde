// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/checks/speed_check.h"

#include <limits>

#include <fmt/format.h>

#include "atom.h"
#include "core/communicator.h"
#include "core/error.h"
#include "coupling/liggghts/fixes_of.h"
#include "coupling/checks/driven_bodies.h"
#include "coupling/checks/touch_check.h"
#include "coupling/contact/fix_contact_continuum.h"
#include "coupling/terrain/fix_terrain_continuum.h"
#include "update.h"

namespace furrow::coupling {

namespace {

// over the wave speed: beyond it the ground ahead answers as to an impact, not to a roll
constexpr double mach_warning = 0.3, mach_limit = 1.0;
// travel in a step over the radius of the smallest grain
constexpr double travel_warning = 0.1, travel_limit = 1.0;

/// Refuses a share of a limit, or warns of it.
void judge(double share, double warning, double limit, const DrivenBody& speed,
           const std::string& finding, const std::string& remedy, const Warn& warn) {
  const std::string problem =
      fmt::format("is {:.4g} m/s, {}", speed.options.number("speed"), finding);
  if (share > limit)
    throw InputError(
        speed.options.where("speed"), problem,
        fmt::format("at most {:.3g} m/s here", limit / share * speed.options.number("speed")),
        remedy);
  if (share > warning)
    warn(fmt::format("{} {}; {}", speed.options.where("speed"), problem, remedy));
}

void check_against_waves(const LAMMPS_NS::LAMMPS& lammps, const DrivenBody& speed,
                         const Warn& warn) {
  for (auto* contact : fixes_of<FixContactContinuum>(*lammps.modify)) {
    if (&contact->body_fix() != &speed.body) continue;
    const ContinuumTerrain& terrain = contact->terrain_fix().terrain();
    const double wave =
        terrain.parameters().cfl * terrain.grid().shortest_cell() / terrain.stable_time_step();
    const double share = speed.options.number("speed") / wave;
    judge(share, mach_warning, mach_limit, speed,
          fmt::format("{:.2g} of the speed of waves in the terrain '{}', {:.4g} m/s", share,
                      contact->terrain_fix().id, wave),
          "choose a lower speed, or a modulus_scale nearer to 1", warn);
  }
}

void check_against_grains(const LAMMPS_NS::LAMMPS& lammps, const DrivenBody& speed,
                          const Warn& warn) {
  if (!touches_grains(lammps, speed.body)) return;
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < atom.nlocal; ++i) smallest = std::min(smallest, atom.radius[i]);
  smallest = -Communicator(&lammps.world).max(-smallest);
  const double share = speed.options.number("speed") * lammps.update->dt / smallest;
  judge(
      share, travel_warning, travel_limit, speed,
      fmt::format("so that the body moves by {:.2g} radii of the smallest grain in a step", share),
      "choose a lower speed or a shorter timestep", warn);
}

}  // namespace

void check_speeds(LAMMPS_NS::LAMMPS& lammps, const Warn& warn) {
  for (const DrivenBody& speed : driven_bodies(*lammps.modify)) {
    if (!speed.options.has("speed")) continue;  // free travel: it is an answer
    check_against_waves(lammps, speed, warn);
    check_against_grains(lammps, speed, warn);
  }
}

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/checks/grain_motion_check.h"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "atom.h"
#include "core/communicator.h"
#include "core/error.h"
#include "core/types.h"
#include "coupling/liggghts/fixes_of.h"
#include "coupling/checks/lost_grains_check.h"
#include "coupling/contact/fix_wall_gran_body.h"
#include "coupling/contact/grain_bed_check.h"
#include "fix_gravity.h"

namespace furrow::coupling {

namespace {

constexpr char remedy[] = "write 'fix move all nve/sphere'";

// Of gravity: a slope of 60 degrees, steeper than any ground stands.
constexpr double least_downward_share = 0.5;

/// A bed under a body needs weight, and has one.
void check_gravity(const LAMMPS_NS::LAMMPS& lammps, double grains, const Warn& warn) {
  if (grains < GrainBedLimits::min_grains ||
      fixes_of<const FixWallGranBody>(*lammps.modify).empty())
    return;
  int count = 0;
  for (const auto* fix : fixes_of<const LAMMPS_NS::Fix>(*lammps.modify))
    count += fix->style == std::string("gravity");
  if (count == 0)
    warn("no fix gives the grains weight; write 'fix weight all gravity 9.80665 vector 0 0 -1'");
  if (count > 1)
    warn(fmt::format("{} fixes gravity act together; grains have that many weights", count));
}

/// `nve` leaves out what turns a grain.
void warn_of_grains_that_do_not_turn(const LAMMPS_NS::Fix& mover, const Warn& warn) {
  if (mover.style == std::string("nve"))
    warn(
        fmt::format("fix nve '{}' moves grains and does not turn them, whatever torque they have; "
                    "write 'nve/sphere'",
                    mover.id));
}

using Fixes = std::vector<const LAMMPS_NS::Fix*>;

/// @throws InputError when two of them move a grain of this rank or another
void refuse_double_motion(const LAMMPS_NS::LAMMPS& lammps, const Fixes& movers,
                          const Communicator& ranks) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  for (std::size_t a = 0; a < movers.size(); ++a)
    for (std::size_t b = a + 1; b < movers.size(); ++b) {
      const LAMMPS_NS::Fix &first = *movers[a], &second = *movers[b];
      double both = 0.0;
      for (int i = 0; i < atom.nlocal; ++i)
        if ((atom.mask[i] & first.groupbit) && (atom.mask[i] & second.groupbit)) both += 1.0;
      both = ranks.sum(both);
      if (both > 0.0)
        throw InputError(
            fmt::format("fix {} '{}'", second.style, second.id),
            fmt::format("moves {:.0f} grain(s) that fix {} '{}' moves already", both, first.style,
                        first.id),
            "one such fix for each grain",
            fmt::format("remove one of the lines, write 'unfix {}' before, or give them groups "
                        "without a common grain",
                        first.id));
    }
}

}  // namespace

bool moves_grains(const LAMMPS_NS::Fix& fix) {
  return fix.time_integrate != 0 || std::string(fix.style).rfind("multisphere", 0) == 0;
}

bool freezes_grains(const LAMMPS_NS::Fix& fix) { return fix.style == std::string("freeze"); }

void check_weight(const LAMMPS_NS::LAMMPS& lammps, const Warn& warn) {
  if (lammps.atom->natoms == 0) return;
  for (auto* fix : fixes_of<LAMMPS_NS::FixGravity>(*lammps.modify)) {
    Vector3 weight;
    fix->get_gravity(weight.data());
    if (-weight.z() < least_downward_share * weight.norm())
      warn(
          fmt::format("fix gravity '{}' is {:.4g} {:.4g} {:.4g} m/s^2, which does not pull grains "
                      "down; down is 'vector 0 0 -1'",
                      fix->id, weight.x(), weight.y(), weight.z()));
  }
}

void check_grain_motion(const LAMMPS_NS::LAMMPS& lammps, const Warn& warn) {
  const Communicator ranks(&lammps.world);
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  Fixes movers;
  int moved_or_frozen = 0;  // bits of their groups
  for (const auto* fix : fixes_of<const LAMMPS_NS::Fix>(*lammps.modify)) {
    if (fix->time_integrate != 0) movers.push_back(fix);
    if (lammps.atom->natoms > 0) warn_of_grains_that_do_not_turn(*fix, warn);
    if (moves_grains(*fix) || freezes_grains(*fix)) moved_or_frozen |= fix->groupbit;
  }
  refuse_double_motion(lammps, movers, ranks);

  const double all = count_grains(lammps);
  check_gravity(lammps, all, warn);

  double still = 0.0;
  for (int i = 0; i < atom.nlocal; ++i)
    if (!(atom.mask[i] & moved_or_frozen)) still += 1.0;
  still = ranks.sum(still);
  if (still == 0.0) return;
  const auto walls = fixes_of<const FixWallGranBody>(*lammps.modify);
  if (still == all && all >= GrainBedLimits::min_grains && !walls.empty())
    throw InputError(
        fmt::format("fix wall/gran/body '{}'", walls.front()->id),
        fmt::format("presses on grains, and no fix moves any of the {:.0f}", all),
        "grains that a fix moves or freezes",
        fmt::format("{}, or 'fix still all freeze' for grains that stand still", remedy));
  warn(
      fmt::format("no fix moves {:.0f} of {:.0f} grains: they stand still; {}, or 'fix still "
                  "<group> freeze' if that is meant",
                  still, all, remedy));
}

}  // namespace furrow::coupling

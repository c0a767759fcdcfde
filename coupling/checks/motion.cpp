// SPDX-License-Identifier: GPL-2.0-or-later
// Rules for what moves: does one fix, and only one, move each grain; do wheels and plates move at
// speeds that the ground and the step can follow?

#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "atom.h"
#include "core/communicator.h"
#include "core/types.h"
#include "coupling/liggghts/fixes_of.h"
#include "coupling/base/grain_check.h"
#include "coupling/bodies/fix_plate_rigid.h"
#include "coupling/base/fix_wheel_hub.h"
#include "coupling/checks/scene_checks.h"
#include "coupling/contact/grain_bed_check.h"
#include "coupling/drive/fix_wheel_rig.h"
#include "coupling/laboratory/fix_cell_servo.h"

namespace furrow::coupling {

namespace {

constexpr char move_all[] = "write 'fix move all nve/sphere'";
// Of gravity: a slope of 60 degrees, steeper than any ground stands.
constexpr double least_downward_share = 0.5;
// over the wave speed
constexpr double mach_warning = 0.3, mach_limit = 1.0;
// travel in a step over the radius of the smallest grain
constexpr double travel_warning = 0.1, travel_limit = 1.0;

/// Refuses a share of a limit, or warns of it.
Found judge(double share, double warned, double limit, const Options& speed,
            const std::string& finding, const std::string& remedy) {
  const std::string problem = fmt::format("is {:.4g} m/s, {}", speed.number("speed"), finding);
  if (share > limit)
    return refusal(speed.where("speed"), problem,
                   fmt::format("at most {:.3g} m/s here", limit / share * speed.number("speed")),
                   remedy);
  if (share > warned)
    return warning(fmt::format("{} {}; {}", speed.where("speed"), problem, remedy));
  return {};
}

}  // namespace

std::vector<DrivenBody> driven_bodies(const LAMMPS_NS::Modify& modify) {
  std::vector<DrivenBody> driven;
  for (auto* rig : fixes_of<FixWheelRig>(modify))
    driven.push_back({rig->wheel_fix(), rig->options(), rig->rig().cruise_start(),
                      "start, settle_time and accelerate_time"});
  for (auto* plate : fixes_of<FixPlateRigid>(modify))
    driven.push_back({*plate, plate->options(), plate->full_speed(), "start and accelerate_time"});
  return driven;
}

Found moved_mesh_has_no_body(const Scene&, LAMMPS_NS::FixMoveMesh& motion) {
  const auto* mesh = dynamic_cast<const FixMeshBody*>(motion.fixMesh());
  if (!mesh) return {};
  return refusal(fmt::format("fix {} '{}'", motion.style, motion.id),
                 fmt::format("moves the mesh/body '{}', which follows its body", mesh->id),
                 "a mesh that no body has", "drive the body: by a wheel/rig, or as a plate/rigid");
}

Found grains_turn(const Scene& scene, const LAMMPS_NS::Fix& mover) {
  if (scene.lammps.atom->natoms == 0 || mover.style != std::string("nve")) return {};
  return warning(fmt::format(
      "fix nve '{}' moves grains and does not turn them, whatever torque they have; write "
      "'nve/sphere'",
      mover.id));
}

Found one_fix_moves_a_grain(const Scene& scene) {
  const LAMMPS_NS::Atom& atom = *scene.lammps.atom;
  std::vector<const LAMMPS_NS::Fix*> movers;
  for (const auto* fix : fixes_of<const LAMMPS_NS::Fix>(*scene.lammps.modify))
    if (fix->time_integrate != 0) movers.push_back(fix);
  for (std::size_t a = 0; a < movers.size(); ++a)
    for (std::size_t b = a + 1; b < movers.size(); ++b) {
      const LAMMPS_NS::Fix &first = *movers[a], &second = *movers[b];
      double both = 0.0;
      for (int i = 0; i < atom.nlocal; ++i)
        if ((atom.mask[i] & first.groupbit) && (atom.mask[i] & second.groupbit)) both += 1.0;
      both = Communicator(&scene.lammps.world).sum(both);
      if (both > 0.0)
        return refusal(
            fmt::format("fix {} '{}'", second.style, second.id),
            fmt::format("moves {:.0f} grain(s) that fix {} '{}' moves already", both, first.style,
                        first.id),
            "one such fix for each grain",
            fmt::format("remove one of the lines, write 'unfix {}' before, or give them groups "
                        "without a common grain",
                        first.id));
    }
  return {};
}

Found bed_has_one_weight(const Scene& scene) {
  const LAMMPS_NS::Modify& modify = *scene.lammps.modify;
  if (scene.grains < GrainBedLimits::min_grains || fixes_of<const FixWallGranBody>(modify).empty())
    return {};
  const std::size_t count = fixes_of<LAMMPS_NS::FixGravity>(modify).size();
  if (count == 0)
    return warning(
        "no fix gives the grains weight; write 'fix weight all gravity 9.80665 vector 0 0 -1'");
  if (count > 1)
    return warning(
        fmt::format("{} fixes gravity act together; grains have that many weights", count));
  return {};
}

Found some_fix_moves_a_grain(const Scene& scene) {
  const LAMMPS_NS::Atom& atom = *scene.lammps.atom;
  int moved_or_frozen = 0;  // bits of their groups
  for (const auto* fix : fixes_of<const LAMMPS_NS::Fix>(*scene.lammps.modify))
    if (moves_grains(*fix) || freezes_grains(*fix)) moved_or_frozen |= fix->groupbit;
  double still = 0.0;
  for (int i = 0; i < atom.nlocal; ++i)
    if (!(atom.mask[i] & moved_or_frozen)) still += 1.0;
  still = Communicator(&scene.lammps.world).sum(still);
  if (still == 0.0) return {};
  const auto walls = fixes_of<const FixWallGranBody>(*scene.lammps.modify);
  if (still == scene.grains && still >= GrainBedLimits::min_grains && !walls.empty())
    return refusal(
        fmt::format("fix wall/gran/body '{}'", walls.front()->id),
        fmt::format("presses on grains, and no fix moves any of the {:.0f}", still),
        "grains that a fix moves or freezes",
        fmt::format("{}, or 'fix still all freeze' for grains that stand still", move_all));
  return warning(
      fmt::format("no fix moves {:.0f} of {:.0f} grains: they stand still; {}, or 'fix still "
                  "<group> freeze' if that is meant",
                  still, scene.grains, move_all));
}

Found weight_pulls_down(const Scene& scene, LAMMPS_NS::FixGravity& gravity) {
  if (scene.lammps.atom->natoms == 0) return {};
  Vector3 weight;
  gravity.get_gravity(weight.data());
  if (-weight.z() >= least_downward_share * weight.norm()) return {};
  return warning(
      fmt::format("fix gravity '{}' is {:.4g} {:.4g} {:.4g} m/s^2, which does not pull grains "
                  "down; down is 'vector 0 0 -1'",
                  gravity.id, weight.x(), weight.y(), weight.z()));
}

Found body_sets_off(const Scene& scene, const DrivenBody& driven) {
  const double start = driven.options.number("start");
  if (start < scene.end()) return {};
  return warning(
      fmt::format("{} is {:.4g} s: this run ends before, and '{}' does not set off; make it "
                  "smaller, or the run longer",
                  driven.options.where("start"), start, driven.body.id));
}

Found body_comes_to_its_speed(const Scene& scene, const DrivenBody& driven) {
  const double end = scene.end();
  const bool stands = driven.options.has("speed") && !(driven.options.number("speed") > 0.0);
  if (driven.options.number("start") >= end || stands ||
      driven.full_speed <= end + 0.5 * scene.step())
    return {};
  return warning(
      fmt::format("{}: '{}' has its speed from {:.4g} s on, after the end of this run, which "
                  "then has no steady values; run longer, or shorten {}",
                  driven.options.subject(), driven.body.id, driven.full_speed, driven.stages));
}

Found waves_outrun_body(const Scene& scene, FixContactContinuum& contact) {
  for (const DrivenBody& driven : driven_bodies(*scene.lammps.modify)) {
    // free travel has no speed: it is an answer
    if (&contact.body_fix() != &driven.body || !driven.options.has("speed")) continue;
    const ContinuumTerrain& terrain = contact.terrain_fix().terrain();
    const double wave =
        terrain.parameters().cfl * terrain.grid().shortest_cell() / terrain.stable_time_step();
    const double share = driven.options.number("speed") / wave;
    return judge(share, mach_warning, mach_limit, driven.options,
                 fmt::format("{:.2g} of the speed of waves in the terrain '{}', {:.4g} m/s", share,
                             contact.terrain_fix().id, wave),
                 "choose a lower speed, or a modulus_scale nearer to 1");
  }
  return {};
}

Found body_passes_no_grain_in_a_step(const Scene& scene, const DrivenBody& driven) {
  if (!driven.options.has("speed") || !touches_grains(scene.lammps, driven.body)) return {};
  const LAMMPS_NS::Atom& atom = *scene.lammps.atom;
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < atom.nlocal; ++i) smallest = std::min(smallest, atom.radius[i]);
  smallest = -Communicator(&scene.lammps.world).max(-smallest);
  const double share = driven.options.number("speed") * scene.step() / smallest;
  return judge(
      share, travel_warning, travel_limit, driven.options,
      fmt::format("so that the body moves by {:.2g} radii of the smallest grain in a step", share),
      "choose a lower speed or a shorter timestep");
}

}  // namespace furrow::coupling

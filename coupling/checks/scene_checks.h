// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Checks that need the scene as a whole: a wheel that touches nothing, cells too wide for it,
/// grains that nothing moves. One table of rules (scene_checks.cpp), which furrow/system applies to
/// every run. Faults that a single line shows are refused by its fix.
///
/// A rule is a function that looks at the scene, at one of its fixes or at one driven body, and
/// returns a finding or nothing. All ranks call it alike, and it returns the same on all.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "coupling/base/checks/finding.h"
#include "coupling/base/fix_body.h"
#include "coupling/contact/grains/fix_mesh_body.h"
#include "coupling/contact/fix_contact_continuum.h"
#include "coupling/contact/fix_contact_plane.h"
#include "coupling/contact/fix_contact_rft.h"
#include "coupling/contact/fix_contact_scm.h"
#include "coupling/contact/grains/fix_wall_gran_body.h"
#include "coupling/base/roles/fix_terrain.h"
#include "coupling/grains/fix_grain_work.h"
#include "coupling/output/histories/fix_wheel_arc.h"
#include "coupling/terrain/bed/fix_bed_window.h"
#include "fix_gravity.h"
#include "fix_move_mesh.h"
#include "lammps.h"

namespace furrow::coupling {

/// Edges of the simulation box [m].
using Box = std::array<double, 6>;

struct Scene {
  LAMMPS_NS::LAMMPS& lammps;
  Box box_of_bodies;    ///< box at the creation of the first body
  double grains = 0.0;  ///< of all ranks, at the start of the run

  double time() const;  ///< [s]
  double step() const;  ///< [s]
  double end() const;   ///< of this run [s]
};

/// A body and the line that drives it: a wheel and its rig, or a plate.
struct DrivenBody {
  const FixBody& body;
  const Options& options;  ///< with the keys "ground_level", "start" and, unless free, "speed"
  double full_speed;       ///< time from which it has its speed [s]
  std::string stages;      ///< the keys of the time until then
};
std::vector<DrivenBody> driven_bodies(const LAMMPS_NS::Modify& modify);

using CheckResult = std::optional<Finding>;

// ---- lines of the script and the step (step.cpp)
/// LIGGGHTS takes "ten" for 0 steps and "1e5" for 1.
CheckResult run_has_whole_numbers(const Scene& scene);
CheckResult timestep_is_given(const Scene& scene);
CheckResult timestep_is_no_zero(const Scene& scene);
/// Bodies take as many sub-steps in a step as their stable step asks for.
CheckResult sub_steps_are_few(const Scene& scene);
CheckResult step_suits_grains(const Scene& scene);
/// Friction below zero would drive the grains, and cohesion push them apart.
CheckResult properties_are_not_negative(const Scene& scene);
/// Finds degrees or percent in the place of a coefficient.
CheckResult friction_is_a_coefficient(const Scene& scene);
CheckResult grains_have_the_density_of_matter(const Scene& scene);
CheckResult grain_work_looks_in_the_run(const Scene& scene, const FixGrainWork& work);
CheckResult arc_is_written_in_the_run(const Scene& scene, const FixWheelArc& arc);

// ---- what moves (motion.cpp)
/// A mesh/body would return to its body in every step.
CheckResult moved_mesh_has_no_body(const Scene& scene, LAMMPS_NS::FixMoveMesh& motion);
/// LIGGGHTS's `nve` leaves out what turns a grain.
CheckResult grains_turn(const Scene& scene, const LAMMPS_NS::Fix& mover);
/// A grain that two fixes move goes twice as far.
CheckResult one_fix_moves_a_grain(const Scene& scene);
CheckResult bed_has_one_weight(const Scene& scene);
CheckResult some_fix_moves_a_grain(const Scene& scene);
/// Checks in a step, when a gravity of variables has its value.
CheckResult weight_pulls_down(const Scene& scene, LAMMPS_NS::FixGravity& gravity);
/// Compares gravity of terrain, of grains, and of the load that a rig makes of a mass.
CheckResult scene_has_one_gravity(const Scene& scene);
CheckResult slope_is_given_once(const Scene& scene);
CheckResult wheels_on_moving_terrain_keep_pace(const Scene& scene, const FixTerrain& terrain);
/// A run may be the first of several: warnings.
CheckResult body_sets_off(const Scene& scene, const DrivenBody& driven);
CheckResult body_comes_to_its_speed(const Scene& scene, const DrivenBody& driven);
/// Beyond the waves' speed the ground ahead answers as to an impact, not to a roll.
CheckResult waves_outrun_body(const Scene& scene, FixContactContinuum& contact);
/// Finds kilometres per hour or centimetres per second in the place of metres per second.
CheckResult speed_suits_the_ground(const Scene& scene, const DrivenBody& driven);
CheckResult sinkage_ends_above_the_base(const Scene& scene, FixContactContinuum& contact);
/// Finds a load in grams, or a body in millimetres.
CheckResult load_suits_the_body(const Scene& scene, const DrivenBody& driven);
/// Finds a wheel or tyre with a mass in grams; plates have no mass.
CheckResult mass_suits_the_load(const Scene& scene, const DrivenBody& driven);
CheckResult body_passes_no_grain_in_a_step(const Scene& scene, const DrivenBody& driven);

// ---- where things are (place.cpp)
Box edges_of_box(const LAMMPS_NS::LAMMPS& lammps);
/// Grains of all ranks. Collective.
double count_grains(const LAMMPS_NS::LAMMPS& lammps);
/// `change_box` moves and stretches grains; bodies and terrain stay.
CheckResult box_is_as_it_was(const Scene& scene);
CheckResult grains_are_above_terrain(const Scene& scene, FixTerrain& terrain);
/// Checks in a step, when gravity is known: grains with no wall, mesh or standing grain below them.
CheckResult grains_have_a_floor(const Scene& scene);
/// Checks after a run: LIGGGHTS drops grains that leave the box without an error.
CheckResult grains_stay_in_the_box(const Scene& scene);
/// Finds two wheels that a copied line has put into one another. @return of the first such body
CheckResult bodies_are_apart(const Scene& scene, const FixBody& body);
CheckResult body_starts_above_the_field(const Scene& scene, FixContactScm& contact);
CheckResult axle_stays_above_the_field(const Scene& scene, FixContactScm& contact);
/// A road below the base is a hard bottom; above it, it carries what the terrain should.
CheckResult plane_is_below_terrain(const Scene& scene, FixContactContinuum& contact);
// Checks in the run in which a body sets off; later there is a rut. A continuum and a plane know
// their level; of grains the highest under the body counts.
CheckResult body_starts_at_the_ground(const Scene& scene, const DrivenBody& driven);
CheckResult ground_level_is_the_ground(const Scene& scene, const DrivenBody& driven);
CheckResult track_is_at_the_ground(const Scene& scene, const FixGrainWork& work);
/// Checks during a run that the base of a terrain does not carry a body.
CheckResult body_stays_off_the_base(const Scene& scene, FixContactContinuum& contact);
/// Checks during a run that no body comes through the grains to the surface mesh of the terrain
/// that carries them.
CheckResult body_stays_off_the_surface_mesh(const Scene& scene, const FixWallGranBody& wall);

// ---- what touches what (contact.cpp)
/// True if a mesh of this body is in a wall/gran/body.
bool touches_grains(const LAMMPS_NS::LAMMPS& lammps, const FixBody& body);
/// A stock wall would move grains without moving the body.
CheckResult stock_wall_has_no_body(const Scene& scene, const LAMMPS_NS::FixWallGran& wall);
CheckResult one_wall_has_all_meshes(const Scene& scene, const FixWallGranBody& wall);
// A wheel may be meant to be free, and a mesh to be drawn only: warnings.
CheckResult mesh_is_in_a_wall(const Scene& scene, const FixMeshBody& mesh);
CheckResult something_presses_on_terrain(const Scene& scene, const FixTerrain& terrain);
CheckResult surface_mesh_is_in_a_wall(const Scene& scene, const FixTerrain& terrain);
/// A wall of LIGGGHTS in the place of the surface mesh carries the grains.
CheckResult no_wall_replaces_the_surface_mesh(const Scene& scene, const FixTerrain& terrain);
CheckResult surcharge_is_the_grains_weight(const Scene& scene, const FixTerrain& terrain);
CheckResult half_terrain_has_half_the_grains(const Scene& scene, const FixTerrain& terrain);
CheckResult body_touches_something(const Scene& scene, FixBody& body);
// Checks that continuum terrain is large enough, and fine enough, for the bodies that press on it.
CheckResult terrain_is_wide_enough(const Scene& scene, FixContactContinuum& contact);
CheckResult terrain_is_deep_enough(const Scene& scene, FixContactContinuum& contact);
CheckResult terrain_is_long_enough(const Scene& scene, FixContactContinuum& contact);
/// Compares terrain with the place to which the rig will bring a wheel by the end of the run.
CheckResult travel_stays_on_terrain(const Scene& scene, FixContactContinuum& contact);
CheckResult travel_stays_on_the_field(const Scene& scene, FixFieldContact& contact);
CheckResult travel_stays_in_the_box(const Scene& scene, const FixMeshBody& mesh);
/// Checks terrain that does not follow its wheel.
CheckResult wheel_stays_off_the_end(const Scene& scene, FixContactContinuum& contact);
/// Finds terrain in centimetres in the place of metres.
CheckResult terrain_has_the_size_of_a_wheels(const Scene& scene, FixContactContinuum& contact);
CheckResult cells_show_the_body(const Scene& scene, FixGroundContact& contact);
CheckResult cells_show_the_grousers(const Scene& scene, FixGroundContact& contact);
CheckResult thin_parts_divide_the_ground(const Scene& scene, FixContactContinuum& contact);
/// Checks after a run, when the sinkage is known.
CheckResult cells_show_the_sinkage(const Scene& scene, FixContactContinuum& contact);
/// The soil contact model has no pressure on upright faces. With camber a side of a wheel is not
/// upright.
CheckResult wheel_on_a_field_has_no_camber(const Scene& scene, FixContactScm& contact);
/// Checks during a run that soil at the sides of a wheel does not push it along its axle.
CheckResult sides_on_a_field_carry_little(const Scene& scene, FixContactScm& contact);
/// Checks during a run that the theory of the contact holds for its grousers.
CheckResult sand_pulls_less_than_the_load(const Scene& scene, FixContactRft& contact);
/// Checks during a run that the ground is used where its card was tested.
CheckResult card_reaches_the_sinkage(const Scene& scene, FixContactScm& contact);
CheckResult card_reaches_the_pressure(const Scene& scene, FixContactScm& contact);
CheckResult body_is_over_terrain(const Scene& scene, FixContactContinuum& contact);
/// A tread without sidewalls is open: ground that flows over its edges is inside of the tyre.
CheckResult sidewalls_touch_the_terrain(const Scene& scene, FixContactContinuum& contact);
CheckResult cells_enter_grooves(const Scene& scene, FixContactContinuum& contact);
CheckResult turning_plate_has_whole_terrain(const Scene& scene, FixContactContinuum& contact);

// ---- checkpoints of the lines 'restart' (checkpoints.cpp)
/// Two runs with one name would replace each other's files.
CheckResult checkpoints_have_one_run(const Scene& scene);
/// Compares the room on the disk with the checkpoints, before the hours until the first one.
CheckResult checkpoints_have_room(const Scene& scene);
/// LIGGGHTS reads the length of a record as an int: 2 GiB.
CheckResult bed_fits_a_record(const Scene& scene, const FixBedWindow& window);

inline constexpr double many_sub_steps = 100;  ///< beyond, a step of LIGGGHTS is a long pause

}  // namespace furrow::coupling

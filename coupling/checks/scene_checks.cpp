// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/checks/scene_checks.h"

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <type_traits>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "coupling/base/fix_coupled_system.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/base/roles/scene_watch.h"
#include "coupling/liggghts/styles/script.h"
#include "update.h"

namespace furrow::coupling {

double Scene::time() const { return FixCoupledSystem::of(lammps).time(); }
double Scene::step() const { return lammps.update->dt; }
double Scene::end() const { return time() + step() * static_cast<double>(lammps.update->nsteps); }

namespace {

constexpr LAMMPS_NS::bigint watch_every = 100;  // steps

using Report = std::function<void(const Finding&)>;

/// Applies a rule to all that it looks at: the scene, each fix of a class or each driven body.
template <auto rule>
struct Apply;
template <CheckResult (*rule)(const Scene&)>
struct Apply<rule> {
  static void to(const Scene& scene, const Report& report) {
    if (const CheckResult found = rule(scene)) report(*found);
  }
};
template <class Item, CheckResult (*rule)(const Scene&, Item&)>
struct Apply<rule> {
  static void to(const Scene& scene, const Report& report) {
    const LAMMPS_NS::Modify& modify = *scene.lammps.modify;
    if constexpr (std::is_same_v<Item, const DrivenBody>) {
      for (Item& body : driven_bodies(modify))
        if (const CheckResult found = rule(scene, body)) report(*found);
    } else {
      for (Item* fix : fixes_of<Item>(modify))
        if (const CheckResult found = rule(scene, *fix)) report(*found);
    }
  }
};

enum class When {
  set_up,      ///< before every run, also one of no steps, of a scene that may not be complete
  before_run,  ///< of one step or more
  first_step,  ///< of a run
  during_run,  ///< in the first step and in every one that watch_every divides
  after_run,
  new_targets,  ///< of a rig, set by a program
};

struct Rule {
  When when;
  void (*apply)(const Scene&, const Report&);
};

template <auto function>
constexpr Rule rule(When when) {
  return {when, Apply<function>::to};
}

/// Within one time they are applied in this order; the first refusal ends the run.
constexpr Rule rules[] = {
    rule<run_has_whole_numbers>(When::set_up),
    rule<stock_wall_has_no_body>(When::set_up),
    rule<one_wall_has_all_meshes>(When::set_up),
    rule<moved_mesh_has_no_body>(When::set_up),

    rule<timestep_is_given>(When::before_run),
    rule<timestep_is_no_zero>(When::before_run),
    rule<step_suits_grains>(When::before_run),
    rule<properties_are_not_negative>(When::before_run),
    rule<friction_is_a_coefficient>(When::before_run),
    rule<grains_have_the_density_of_matter>(When::before_run),
    rule<grain_work_looks_in_the_run>(When::before_run),
    rule<arc_is_written_in_the_run>(When::before_run),
    rule<sub_steps_are_few>(When::before_run),
    rule<box_is_as_it_was>(When::before_run),
    rule<grains_turn>(When::before_run),
    rule<one_fix_moves_a_grain>(When::before_run),
    rule<bed_has_one_weight>(When::before_run),
    rule<some_fix_moves_a_grain>(When::before_run),
    rule<grains_are_above_terrain>(When::before_run),
    rule<mesh_is_in_a_wall>(When::before_run),
    rule<something_presses_on_terrain>(When::before_run),
    rule<surface_mesh_is_in_a_wall>(When::before_run),
    rule<no_wall_replaces_the_surface_mesh>(When::before_run),
    rule<surcharge_is_the_grains_weight>(When::before_run),
    rule<half_terrain_has_half_the_grains>(When::before_run),
    rule<body_touches_something>(When::before_run),
    rule<plane_is_below_terrain>(When::before_run),
    rule<wheels_on_moving_terrain_keep_pace>(When::before_run),
    rule<body_sets_off>(When::before_run),
    rule<body_comes_to_its_speed>(When::before_run),
    rule<terrain_is_wide_enough>(When::before_run),
    rule<terrain_is_deep_enough>(When::before_run),
    rule<terrain_is_long_enough>(When::before_run),
    rule<travel_stays_on_terrain>(When::before_run),
    rule<travel_stays_on_the_field>(When::before_run),
    rule<travel_stays_in_the_box>(When::before_run),
    rule<terrain_has_the_size_of_a_wheels>(When::before_run),
    rule<cells_show_the_body>(When::before_run),
    rule<cells_show_the_grousers>(When::before_run),
    rule<thin_parts_divide_the_ground>(When::before_run),
    rule<wheel_on_a_field_has_no_camber>(When::before_run),
    rule<body_is_over_terrain>(When::before_run),
    rule<sidewalls_touch_the_terrain>(When::before_run),
    rule<cells_enter_grooves>(When::before_run),
    rule<turning_plate_has_whole_terrain>(When::before_run),
    rule<waves_outrun_body>(When::before_run),
    rule<speed_suits_the_ground>(When::before_run),
    rule<sinkage_ends_above_the_base>(When::before_run),
    rule<load_suits_the_body>(When::before_run),
    rule<mass_suits_the_load>(When::before_run),
    rule<body_passes_no_grain_in_a_step>(When::before_run),
    rule<body_starts_at_the_ground>(When::before_run),
    rule<ground_level_is_the_ground>(When::before_run),
    rule<track_is_at_the_ground>(When::before_run),
    rule<checkpoints_have_one_run>(When::before_run),
    rule<checkpoints_have_room>(When::before_run),
    rule<bed_fits_a_record>(When::before_run),

    rule<weight_pulls_down>(When::first_step),
    rule<scene_has_one_gravity>(When::first_step),
    rule<slope_is_given_once>(When::first_step),
    rule<grains_have_a_floor>(When::first_step),
    rule<body_starts_above_the_field>(When::first_step),
    rule<bodies_are_apart>(When::during_run),
    rule<body_stays_off_the_surface_mesh>(When::during_run),
    rule<body_stays_off_the_base>(When::during_run),
    rule<wheel_stays_off_the_end>(When::during_run),
    rule<axle_stays_above_the_field>(When::during_run),
    rule<sides_on_a_field_carry_little>(When::during_run),
    rule<sand_pulls_less_than_the_load>(When::during_run),
    rule<card_reaches_the_sinkage>(When::during_run),
    rule<card_reaches_the_pressure>(When::during_run),

    rule<grains_stay_in_the_box>(When::after_run),
    rule<cells_show_the_sinkage>(When::after_run),

    rule<wheels_on_moving_terrain_keep_pace>(When::new_targets),
    rule<waves_outrun_body>(When::new_targets),
    rule<speed_suits_the_ground>(When::new_targets),
    rule<load_suits_the_body>(When::new_targets),
    rule<mass_suits_the_load>(When::new_targets),
    rule<body_passes_no_grain_in_a_step>(When::new_targets),
};

class SceneChecks : public SceneWatch {
 public:
  explicit SceneChecks(LAMMPS_NS::LAMMPS& lammps) : scene_{lammps, edges_of_box(lammps)} {}

  void before_run() override {
    scene_.grains = count_grains(scene_.lammps);
    first_step_ = true;
    likely_cause_.clear();
    apply(When::set_up);
    if (scene_.lammps.update->nsteps > 0) apply(When::before_run);
  }

  /// A body may come to need shorter steps while it is deformed.
  void after_step(int sub_steps) override {
    if (first_step_) apply(When::first_step);
    if (first_step_ || scene_.lammps.update->ntimestep % watch_every == 0) apply(When::during_run);
    first_step_ = false;
    if (likely_cause_.empty() && sub_steps > many_sub_steps)
      if (const CheckResult found = sub_steps_are_few(scene_)) report(*found);
  }

  void after_run() override { apply(When::after_run); }
  void after_change_of_targets() override { apply(When::new_targets); }

  std::string likely_cause() const override {
    return likely_cause_.empty() ? "" : fmt::format("; a likely cause: {}", likely_cause_);
  }

 private:
  void apply(When when) {
    for (const Rule& rule : rules)
      if (rule.when == when) rule.apply(scene_, [this](const Finding& found) { report(found); });
  }

  /// A warning comes once, however many runs there are.
  void report(const Finding& found) {
    if (found.stops) throw InputError(found.text);
    if (found.explains_errors) likely_cause_ = found.text;
    if (warned_.insert(found.text).second) warn(scene_.lammps, found.text);
  }

  Scene scene_;
  std::set<std::string> warned_;
  std::string likely_cause_;
  bool first_step_ = false;  // of the run, comes next
};

}  // namespace

std::unique_ptr<SceneWatch> watch_scene(LAMMPS_NS::LAMMPS& lammps) {
  return std::make_unique<SceneChecks>(lammps);
}

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/terrain/fix_terrain_continuum.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "comm.h"
#include "core/error.h"
#include "coupling/liggghts/errors.h"
#include "coupling/liggghts/access.h"
#include "coupling/base/args.h"
#include "io/terrain_input.h"
#include "modify.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr long check_every = 100;      // steps between looks at the energy
constexpr double energy_floor = 1e-3;  // [J/kg] of the ground, its weight lifted by 0.1 mm: below
                                       // it an imbalance does not matter

TerrainParameters parameters(const Options& options, const LAMMPS_NS::LAMMPS& lammps) {
  TerrainParameters ground = read_terrain(options, script_folder(lammps));
  ground.window = options.given("follow");
  return ground;
}

}  // namespace

Schema FixTerrainContinuum::schema() {
  Schema schema = terrain_schema("fix terrain/continuum");
  schema.text("follow", "id of the body that the ground moves along with").optional();
  schema
      .number("energy_tolerance", "", Range::positive(),
              "energy that may be missing or made, over the largest work")
      .by_default(0.05);
  return schema;
}

FixTerrainContinuum::FixTerrainContinuum(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixTerrainContinuum(lammps, narg, arg, schema().read(args_after_style(narg, arg))) {}

FixTerrainContinuum::FixTerrainContinuum(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg,
                                         const Options& options)
    : FixBody(lammps, narg, arg,
              std::make_unique<ContinuumTerrain>(parameters(options, *lammps),
                                                 Communicator(&lammps->world), options.subject())),
      options_(options) {
  if (options_.given("follow")) {
    followed_ =
        &FixCoupledSystem::find_body(*lammps, options_.where("follow"), options_.text("follow"))
             .body();
    followed_fix_ = lammps->modify->find_fix_id(options_.text("follow").c_str());
  }
  vector_flag = 1;
  size_vector = 10;
  global_freq = 1;
  extvector = 0;
  nevery = 1;
  report();
}

bool FixTerrainContinuum::uses(LAMMPS_NS::Fix& other) const { return &other == followed_fix_; }
int FixTerrainContinuum::setmask() { return LAMMPS_NS::FixConst::END_OF_STEP; }

void FixTerrainContinuum::report() const {
  const ContinuumTerrain& soil = const_cast<FixTerrainContinuum*>(this)->ground();
  const double particles = soil.particle_count(), step = soil.stable_time_step();
  if (comm->me != 0 || !screen) return;
  const Grid& grid = soil.grid();
  fmt::print(screen,
             "Continuum ground: {} x {} x {} cells, shortest {:.4g} m, {:.0f} particles; stable "
             "step {:.3g} s\n",
             grid.axis(0).cells(), grid.axis(1).cells(), grid.axis(2).cells(), grid.shortest_cell(),
             particles, step);
  const double soften = options_.number("soften");
  if (soften != 1.0)
    fmt::print(screen,
               "WARNING: the ground's elasticity is softened by {:g}: steps are {:.2g} times "
               "longer, elastic strains {:.2g} "
               "times larger\n",
               soften, 1.0 / std::sqrt(soften), 1.0 / soften);
}

void FixTerrainContinuum::post_create() {
  FixBody::post_create();
  FixCoupledSystem::of(*lmp).add(static_cast<MotionController&>(*this));
}

void FixTerrainContinuum::pre_delete(bool unfixflag) {
  FixBody::pre_delete(unfixflag);
  if (unfixflag) FixCoupledSystem::of(*lmp).remove(static_cast<MotionController&>(*this));
}

void FixTerrainContinuum::apply(double, double) {
  if (followed_) ground().follow(followed_->surface().x.row(0).mean());
}

void FixTerrainContinuum::end_of_step() {
  if (update->ntimestep % check_every == 0) with_collective_errors(*error, [&] { check_energy(); });
}

void FixTerrainContinuum::check_energy() {
  const EnergyBudget budget = ground().energy_budget();
  double mass = 0.0;
  for (const ParticleGroup& group : ground().unsynchronised_groups())
    for (std::size_t p = 0; p < group.particles.size(); ++p)
      mass += group.material->density() * group.particles.data(column::volume)[p];
  mass = ground().ranks().sum(mass);
  const double scale = std::max({std::abs(budget.contact_work), std::abs(budget.load_work),
                                 std::abs(budget.dissipated_energy),
                                 std::abs(budget.kinetic_energy), energy_floor * mass});
  const double limit = options_.number("energy_tolerance") * scale, residual = budget.residual();
  if (!(std::abs(residual) <= limit) || !(budget.numerical_loss >= -limit))
    throw StateError(
        fmt::format("fix {}: the energy of the ground does not balance at step {}: {:.4g} J are "
                    "missing between work and state, the "
                    "discretisation has taken {:.4g} J (< 0: made); allowed is {:.4g} J; the step "
                    "is unstable or the load too sudden: "
                    "lower "
                    "cfl, or the LIGGGHTS step",
                    id, update->ntimestep, residual, budget.numerical_loss, limit));
}

double FixTerrainContinuum::compute_vector(int n) {
  switch (n) {
    case 0:
      return ground().particle_count();
    case 8:
      return ground().travelled();
    case 9:
      return ground().stable_time_step();
    default:
      break;
  }
  const EnergyBudget budget = ground().energy_budget();
  const double values[] = {0.0,
                           budget.kinetic_energy,
                           budget.stored_energy,
                           budget.dissipated_energy,
                           budget.contact_work,
                           budget.load_work,
                           budget.numerical_loss,
                           budget.residual()};
  return values[n];
}

}  // namespace furrow::coupling

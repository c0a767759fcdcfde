// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/continuum_terrain.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "furrow/mpm/ground/terrain_size.h"

namespace furrow {

namespace {

Discretisation discretise(const TerrainParameters& parameters, const Communicator& ranks,
                          const std::string& where) {
  check_memory(parameters, ranks, where);
  Grid grid = make_grid(parameters, where);
  const BlockLayout blocks =
      parameters.blocks ? *parameters.blocks
                        : choose_layout(ranks.size(), grid.axis(0).cells(), grid.axis(1).cells());
  check_layout(blocks, ranks.size(), where + ", keyword 'blocks'");
  std::vector<ParticleGroup> groups;
  for (int field = 0; field < grid.fields(); ++field)
    for (std::size_t n = 0; n < parameters.layers.size(); ++n) {
      const std::shared_ptr<const Material>& material = parameters.layers[n].material;
      groups.push_back({material, Particles(*material), n, field});
    }
  const Partition partition(ranks, blocks, grid);
  grid.store(partition.local_nodes());
  return {std::move(grid), std::move(groups), partition};
}

/// Collective.
void check_both_sides(const Discretisation& discretisation, const std::string& where) {
  double count[2] = {0.0, 0.0};
  for (const ParticleGroup& group : discretisation.groups)
    count[group.field] += static_cast<double>(group.particles.size());
  discretisation.ranks().sum(count, 2);
  if (!(count[0] > 0.0) || !(count[1] > 0.0))
    throw InputError(where, "has a slide surface that leaves all of it on one side",
                     "a surface that goes through the ground",
                     "look at the surface's place, and at 'centre' and 'surface' of the ground");
}

/// Refuses options of a terrain that sleeping ground does not support. @throws InputError
void check_active(const TerrainParameters& parameters, const std::string& where) {
  const auto refuse = [&](const std::string& what, const std::string& remedy) {
    throw InputError(where + ", keyword 'sleep_tolerance'", "is given with " + what,
                     "ground of one piece that stays where it is, carries no grains and does not "
                     "creep",
                     remedy);
  };
  if (parameters.window) refuse("'follow'", "remove one of the two");
  if (parameters.slide) refuse("a slide surface", "remove one of the two");
  if (parameters.surface_mesh) refuse("'surface_mesh yes'", "remove one of the two");
  for (const TerrainLayer& layer : parameters.layers)
    if (layer.material->rate_dependent())
      refuse("a material that depends on the rate",
             "remove 'sleep_tolerance', or 'relaxation_time' or 'rate_share' of the material");
}

std::optional<ActiveGround> make_active(const TerrainParameters& parameters,
                                        Discretisation& discretisation, Boundary& boundary,
                                        const TerrainEnergy& energy, const std::string& where) {
  if (!(parameters.sleep_tolerance > 0.0)) return {};
  check_active(parameters, where);
  return ActiveGround(parameters.sleep_tolerance, parameters.gravity, discretisation, boundary,
                      energy);
}

/// Refuses thin parts with other parts that have velocity fields, or know one only. @throws
/// InputError
std::optional<DividedGround> make_divided(const TerrainParameters& parameters,
                                          Discretisation& discretisation,
                                          const std::string& where) {
  if (!parameters.thin_parts) return {};
  const auto refuse = [&](const std::string& what) {
    throw InputError(where + ", keyword 'thin_parts'", "is given with " + what,
                     "ground of one piece that is all computed and carries no grains",
                     "remove one of the two");
  };
  if (parameters.slide) refuse("a slide surface");
  if (parameters.sleep_tolerance > 0.0) refuse("'sleep_tolerance'");
  if (parameters.surface_mesh) refuse("'surface_mesh yes'");
  return DividedGround(discretisation, parameters.boundary);
}

std::optional<ParticleRefinement> make_refinement(const TerrainParameters& parameters,
                                                  const Grid& grid, const std::string& where) {
  if (parameters.halvings == 0) return {};
  return ParticleRefinement(parameters, grid, where);
}

}  // namespace

ContinuumTerrain::ContinuumTerrain(const TerrainParameters& parameters, const Communicator& ranks,
                                   const std::string& where)
    : parameters_(parameters),
      discretisation_(discretise(parameters, ranks, where)),
      fill_(parameters, discretisation_.grid, where),
      boundary_(discretisation_.grid, parameters.boundary, parameters.particles_per_cell,
                fill_.wave_speeds(discretisation_.grid)),
      distribution_(discretisation_, boundary_),
      remap_(discretisation_, parameters.remap_interval, parameters.scheme.residual_share,
             fill_.slowest_wave_speed()),
      loads_(discretisation_, remap_),
      slide_(parameters.slide),
      active_(make_active(parameters, discretisation_, boundary_, energy_, where)),
      divided_(make_divided(parameters, discretisation_, where)),
      refinement_(make_refinement(parameters, discretisation_.grid, where)),
      step_(discretisation_, boundary_, distribution_, remap_, loads_, energy_, parameters.gravity,
            parameters.scheme, slide_ ? &*slide_ : nullptr, active_ ? &*active_ : nullptr,
            divided_ ? &*divided_ : nullptr),
      window_(parameters, discretisation_, distribution_, boundary_, fill_, energy_, where) {
  fill(where);
  step_.capture_initial_tractions();
}

void ContinuumTerrain::fill(const std::string& where) {
  fill_.fill(discretisation_);
  if (refinement_) refinement_->refine(discretisation_.groups);
  if (slide_) check_both_sides(discretisation_, where);
  energy_.add_initial(internal_energy(discretisation_.groups));
  if (parameters_.surface_mesh)
    free_surface_ = FreeSurfaceMesh(fill_, grid(), parameters_.surface_mesh_every,
                                    std::max<std::size_t>(1, parameters_.slabs));
  sort_particles();
  if (free_surface_.exists()) free_surface_.update(discretisation_.groups, loads_, ranks());
}

void ContinuumTerrain::place_surface_mesh() {
  if (free_surface_.exists()) free_surface_.place(fill_, grid(), window_.dropped_slabs());
}

void ContinuumTerrain::sort_particles() {
  if (divided_) divided_->sort();
  distribution_.sort();
  if (active_) active_->rebuild();
  if (free_surface_.exists()) free_surface_.attach(discretisation_.groups);
}

/// With affine transfers the d_i/sqrt(D) are orthonormal under the weights N_i, so that
/// |sum_i u_i G_i^T|^2 <= sum_i N_i |u_i|^2/D (Bessel) and omega^2 <= 3 K/(rho D) with D = h^2/4
/// and the largest eigenvalue 3 K of an elasticity with nu >= 0: for any arrangement of particles
/// away from faces. Wave speeds have the modulus M in the place of 3 K; cfl makes up for that
/// (coupling/terrain/fix_terrain_continuum.md).
double ContinuumTerrain::stable_step_now() const {
  double wave_speed = 0.0;
  for (const ParticleGroup& group : discretisation_.groups)
    group.for_awake([&](std::size_t from, std::size_t to) {
      wave_speed = std::max(wave_speed, group.largest_wave_speed(from, to));
    });
  if (active_) wave_speed = std::max(wave_speed, active_->resting_wave_speed());
  return parameters_.cfl * grid().shortest_cell() /
         ranks().max(wave_speed + remap_.largest_speed());
}

double ContinuumTerrain::stable_time_step() const {
  return multirate_.begun() ? multirate_.stable_step() : stable_step_now();
}

void ContinuumTerrain::advance(double dt) {
  Surface& mesh = free_surface_.surface();
  if (!parameters_.multirate) {
    step(dt, mesh.f);
    return;
  }
  if (!multirate_.begun()) multirate_.begin(mesh, dt, stable_step_now());
  if (!multirate_.add(mesh, dt)) return;
  step(multirate_.elapsed(), multirate_.mean_force());
  multirate_.begin(mesh, dt, stable_step_now());
}

void ContinuumTerrain::step(double dt, const Matrix3X& surface_forces) {
  if (free_surface_.exists())
    free_surface_.add_forces_to(loads_, discretisation_.groups, surface_forces);
  step_.advance(dt);
  if (!remap_.interval_running()) {
    const bool moved = window_.move();
    if (moved) place_surface_mesh();
    if (moved && refinement_) refinement_->refine(discretisation_.groups);
    const bool decided = active_ && active_->decide();
    if (moved || decided || distribution_.sorting_due() || (divided_ && divided_->sorting_due()))
      sort_particles();
  }
  if (divided_) divided_->end_step();
  if (free_surface_.exists()) {
    step_.grid_to_particles();
    free_surface_.update(discretisation_.groups, loads_, ranks());
  }
}

std::vector<ParticleGroup>& ContinuumTerrain::groups() {
  step_.grid_to_particles();
  return discretisation_.groups;
}

void ContinuumTerrain::interpolate_motion(const std::vector<ParticleIndex>& particles,
                                          std::vector<ParticleMotion>& motions) {
  loads_.interpolate_motion(particles, motions);
}

void ContinuumTerrain::add_point_force(const ParticleIndex& near, const Vector3& force,
                                       const Vector3& point, double* work) {
  loads_.add(near, force, point, work);
}

void ContinuumTerrain::keep_awake_near(const Surface& surface) {
  if (!active_ || remap_.interval_running()) return;
  const auto [lower, upper] = surface.bounds();
  active_->keep_awake(lower, upper);
}

EnergyBudget ContinuumTerrain::energy_budget() const {
  const Vector3 momentum =
      remap_.particles_lag() ? energy_.node_totals().momentum : momentum_of(discretisation_.groups);
  return energy_.energy_budget(discretisation_.groups, momentum, boundary_.work(), ranks());
}

Vector3 ContinuumTerrain::boundary_impulse(Face face) const {
  Vector3 impulse = boundary_.impulse(face);
  ranks().sum(impulse.data(), 3);
  return impulse;
}

double ContinuumTerrain::slide_loss() const { return ranks().sum(energy_.slide_loss()); }

double ContinuumTerrain::particle_count() const {
  double count = 0.0;
  for (const ParticleGroup& group : discretisation_.groups)
    count += static_cast<double>(group.particles.size());
  return ranks().sum(count);
}

void ContinuumTerrain::checkpoint(Checkpoint& state) {
  if (!rank_numbers_) throw Error(state.owner() + ": a checkpoint has no place for particles");
  for (int a = 0; a < 3; ++a) {
    state.match("cells", grid().axis(a).cells());
    state.match("shortest_cell", grid().axis(a).shortest_at_start());
  }
  state.match("layers", discretisation_.groups.size());
  for (const TerrainLayer& layer : parameters_.layers) match_layer(layer, state);
  for (ParticleGroup& group : discretisation_.groups) {
    state.match("density", group.material->density());
    group.particles.checkpoint_columns(state);
    state.match("numbers_of_a_particle", group.particles.record_length());
  }
  state.match("surface_nodes", free_surface_.surface().node_count());
  window_.checkpoint_position(state);
  energy_.checkpoint(state, ranks());
  fill_.checkpoint(state);
  remap_.checkpoint(state);
  window_.checkpoint_rut(state);
  state.values("free_surface_force", free_surface_.surface().f);
  if (parameters_.multirate) multirate_.checkpoint(state, free_surface_.surface().x.cols());
  checkpoint_boundary(state);
  discretisation_.exchange.checkpoint(state, ranks());
  if (active_) active_->checkpoint(state);
  if (divided_) divided_->checkpoint(state);
  distribution_.checkpoint_drift(state);
  distribution_.checkpoint_values(state, *std::exchange(rank_numbers_, nullptr));
  if (!state.saving()) resume();
}

double ContinuumTerrain::checkpoint_size() const {
  auto numbers = static_cast<double>(grid().saved_length(grid().stored()));
  for (const ParticleGroup& group : discretisation_.groups)
    numbers += static_cast<double>(group.particles.size() * group.particles.record_length());
  return sizeof(double) * ranks().sum(numbers);
}

void ContinuumTerrain::checkpoint_boundary(Checkpoint& state) {
  if (state.saving()) {
    boundary_.synchronise(ranks(), discretisation_.partition.owned_nodes());
    boundary_.sum_over_ranks(ranks());
  }
  boundary_.checkpoint(state, ranks().rank() == 0);
}

/// Compares a layer key by key, so that an error names the one that differs.
void ContinuumTerrain::match_layer(const TerrainLayer& layer, Checkpoint& state) {
  state.match("thickness of a layer", layer.thickness);
  state.match("number of its keys", layer.description.size());
  for (const Entry& entry : layer.description)
    state.match(fmt::format("'{}' of a layer", entry.key),
                fmt::format("{}", fmt::join(entry.values, " ")));
}

/// Rebuilds everything that follows from the restored particles and nodes.
void ContinuumTerrain::resume() {
  if (active_) active_->resume();
  if (divided_) divided_->resume();
  step_.restore_stress_forces();
  if (!free_surface_.exists()) return;
  place_surface_mesh();
  free_surface_.attach(discretisation_.groups);
  free_surface_.update(discretisation_.groups, loads_, ranks());
  multirate_.resume(free_surface_.surface());
}

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/contact/terrain_contact.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/mpm/contact/contact_checks.h"

namespace furrow {

TerrainContact::TerrainContact(Body& body, ContinuumTerrain& terrain,
                               const ContactParameters& parameters, bool half_model,
                               const std::string& where)
    : body_(body),
      terrain_(terrain),
      law_(make_contact_law(parameters, where)),
      search_(body, terrain),
      narrow_phase_(body) {
  std::visit([&](auto& law) { law.fit(terrain.parameters(), where); }, law_);
  if (half_model) mirror_.emplace(body.surface(), terrain.grid().axis(1).lower(), where);
  if (terrain.parameters().thin_parts)
    thin_parts_ = DividedGround::parts_of(body.surface(), terrain.parameters().x.cell);
  for (ParticleGroup& group : terrain_.unsynchronised_groups())
    history_columns_.push_back(
        group.particles.add_column(where, contact_history_numbers, ContactHistory::is_idle));
}

void TerrainContact::apply(double dt) {
  terrain_.keep_awake_near(body_.surface());
  terrain_.divide_by(body_.surface(), thin_parts_);
  if (search_.is_outdated()) search();
  search_.add_terrain_travel(terrain_.largest_speed() * dt);
  select_active();
  terrain_.interpolate_motion(active_particles_, motions_);
  nodal_forces_.setZero(3, body_.surface().x.cols());
  step_ = {};
  std::visit([&](const auto& law) { add_forces(law, dt); }, law_);
  sum_over_ranks();
  if (mirror_) add_other_half();
  record_step();
  body_.surface().f += nodal_forces_;
  last_dt_ = dt;
}

ContactHistory& TerrainContact::history_of(const ParticleIndex& particle) {
  return reinterpret_cast<ContactHistory*>(
      history_columns_[particle.group].data())[particle.particle];
}

void TerrainContact::search() {
  check_within_terrain(body_.surface(), terrain_.grid());
  search_.search();
  if (!begun_) check_no_overlap(body_.surface(), terrain_.unsynchronised_groups());
  begun_ = true;
}

/// Leaves out the candidates that cannot have come near enough since the search. A particle that
/// has slipped leaves the surface at twice its reach only.
void TerrainContact::select_active() {
  active_.clear();
  active_particles_.clear();
  const std::vector<ContactSearch::Candidate>& candidates = search_.candidates();
  for (std::size_t n = 0; n < candidates.size(); ++n) {
    const ParticleIndex& particle = candidates[n].particle;
    ContactHistory& history = history_of(particle);
    const double reach =
        NarrowPhase::largest_reach(group_of(particle).particles, particle.particle, history);
    // a particle that touches may be inside, farther than its reach
    if (!history.touches() &&
        search_.lower_bound(candidates[n]) > (history.slip > 0.0 ? 2.0 : 1.0) * reach) {
      history.end_contact();
      continue;
    }
    active_.push_back(n);
    active_particles_.push_back(particle);
  }
}

/// Contact of the active particles of one cell, from number n on.
/// @param end  of these active particles
TerrainContact::CellContact TerrainContact::contact_in_cell(std::size_t n, std::size_t& end) {
  const auto cell = [&](std::size_t m) {
    const ParticleIndex& particle = active_particles_[m];
    return std::pair(particle.group,
                     group_of(particle).particles.data(column::cell)[particle.particle]);
  };
  const auto this_cell = cell(n);
  double sum = 0.0;
  int touching = 0, bouncing = 0;
  for (end = n; end < active_particles_.size() && cell(end) == this_cell; ++end) {
    const ContactHistory& history = history_of(active_particles_[end]);
    if (history.touches()) {
      sum += history.slip;
      ++touching;
    } else if (history.bounces()) {
      ++bouncing;
    }
  }
  if (touching == 0) return {};
  return {sum / touching, 1.0 + static_cast<double>(bouncing) / touching};
}

template <class Law>
void TerrainContact::add_forces(const Law& law, double dt) {
  CellContact cell;
  for (std::size_t n = 0, end_of_cell = 0; n < active_.size(); ++n) {
    if (n == end_of_cell) cell = contact_in_cell(n, end_of_cell);
    const ParticleIndex& particle = active_particles_[n];
    const ParticleGroup& group = group_of(particle);
    ContactHistory& history = history_of(particle);
    const bool touched = history.touches();
    if (touched) law.update_stiffness(group, particle.particle, history);
    Vector3 velocity;
    const ContactPoint contact = find_contact(n, history, velocity);
    if (contact.gap >= 0.0) {
      const double reach = contact.distance - contact.gap;
      if (contact.gap > reach || history.slip == 0.0)
        history.end_contact();
      else
        history.lift(last_dt_ * velocity.cross(contact.normal).norm());
      continue;
    }
    if (!touched) law.update_stiffness(group, particle.particle, history);
    if (history.slip == 0.0) history.slip = cell.slip;
    history.gap = contact.gap;
    history.normal = contact.normal;
    history.triangle = static_cast<double>(contact.triangle);
    history.barycentric = contact.barycentric;
    const double length = std::cbrt(group.particles.data(column::volume)[particle.particle]);
    const double area = length * length * cell.area_share;
    const Vector3 force =
        law.force({contact, velocity, group.mass(particle.particle), area, last_dt_}, dt, history,
                  step_.losses);
    add_force(particle, contact, force, velocity, dt);
    step_.area += area;
  }
}

/// Finds the point where an active particle touches or is nearest, with its gap now.
/// @param velocity  of the ground relative to the surface there [m/s]
ContactPoint TerrainContact::find_contact(std::size_t n, ContactHistory& history,
                                          Vector3& velocity) {
  const Surface& surface = body_.surface();
  const ParticleIndex& particle = active_particles_[n];
  const Particles& particles = group_of(particle).particles;
  ContactPoint contact = narrow_phase_.find(search_, search_.candidates()[active_[n]], particles,
                                            motions_[n].position, history);
  const Vector3i& nodes = surface.triangles[contact.triangle];
  velocity = motions_[n].velocity_at(contact.position);
  for (int c = 0; c < 3; ++c) velocity -= contact.barycentric[c] * surface.v.col(nodes[c]);
  if (!history.touches()) return contact;
  Vector3 velocity_there = velocity;
  if (contact.switches_facet)
    velocity_there = motions_[n].velocity_at(narrow_phase_.point_of(surface.x, history)) -
                     narrow_phase_.point_of(surface.v, history);
  NarrowPhase::follow(velocity, velocity_there, last_dt_, particles, particle.particle, history,
                      contact);
  return contact;
}

/// Adds a force to the ground and its opposite to the surface.
void TerrainContact::add_force(const ParticleIndex& particle, const ContactPoint& contact,
                               const Vector3& force, const Vector3& velocity, double dt) {
  const Vector3i& nodes = body_.surface().triangles[contact.triangle];
  terrain_.add_point_force(particle, force, contact.position, &terrain_work_);
  for (int c = 0; c < 3; ++c) nodal_forces_.col(nodes[c]) -= contact.barycentric[c] * force;
  if (ContactRecord* const record = body_.contact_record()) {
    const double symmetry_factor = mirror_ || body_.half_model() ? 2.0 : 1.0;
    record->add(contact.position, -symmetry_factor * force, -velocity, dt);
  }
  step_.contacts += 1.0;
  step_.penetration = std::max(step_.penetration, -contact.gap);
}

void TerrainContact::sum_over_ranks() {
  const Communicator& ranks = terrain_.ranks();
  if (ranks.size() == 1) return;
  // sums of the ranks in one message
  double* sums[] = {&step_.contacts, &step_.area, &step_.losses.friction, &step_.losses.damping};
  std::vector<double> numbers(nodal_forces_.data(), nodal_forces_.data() + nodal_forces_.size());
  for (const double* sum : sums) numbers.push_back(*sum);
  ranks.sum(numbers.data(), numbers.size());
  std::copy_n(numbers.data(), nodal_forces_.size(), nodal_forces_.data());
  const double* next = numbers.data() + nodal_forces_.size();
  for (double* sum : sums) *sum = *next++;
  step_.penetration = ranks.max(step_.penetration);
}

void TerrainContact::add_other_half() {
  mirror_->add_image(nodal_forces_);
  step_.contacts *= 2.0;
  step_.area *= 2.0;
  step_.losses.friction *= 2.0;
  step_.losses.damping *= 2.0;
}

void TerrainContact::record_step() {
  losses_.friction += step_.losses.friction;
  losses_.damping += step_.losses.damping;
  deepest_penetration_ = std::max(deepest_penetration_, step_.penetration);
  if (step_.penetration > max_penetration_cells * terrain_.grid().shortest_cell())
    throw StateError(fmt::format(
        "the surface is {:.3g} m inside the ground, more than half a cell, under {:.3g} "
        "N and at {:.3g} m/s; likely causes: a load or speed too large for this ground, a wheel "
        "much lighter than its load, 'modulus_scale' too low, a time step too large, or a contact "
        "at the edge of the terrain; otherwise raise 'stiffness'",
        step_.penetration, nodal_forces_.rowwise().sum().norm(),
        body_.surface().v.colwise().norm().maxCoeff()));
  force_ = nodal_forces_.rowwise().sum();
}

void TerrainContact::checkpoint(Checkpoint& state) {
  state.match("surface_nodes", body_.surface().x.cols());
  state.value("deepest_penetration", deepest_penetration_);
  state.value("friction_loss", losses_.friction);
  state.value("damping_loss", losses_.damping);
  double work = state.saving() ? terrain_work() : 0.0;
  state.value("terrain_work", work);
  terrain_work_ = terrain_.ranks().rank() == 0 ? work : 0.0;
  state.value("begun", begun_);
  state.values("force", force_);
  state.value("contacts", step_.contacts);
  state.value("area", step_.area);
  state.value("penetration", step_.penetration);
  state.value("last_dt", last_dt_);
  if (terrain_.parameters().thin_parts) checkpoint_parts(state, thin_parts_);
}

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/transfer/point_loads.h"

namespace furrow {

PointLoads::PointLoads(Discretisation& discretisation, RemapControl& remap)
    : discretisation_(discretisation),
      remap_(remap),
      kernels_(transfer_kernels()),
      forces_(static_cast<std::size_t>(discretisation.grid.fields())),
      grid_motions_(forces_.size()) {}

void PointLoads::add(const ParticleIndex& near, const Vector3& force, const Vector3& point,
                     double* work) {
  loads_.push_back({near, force, point, work});
}

Vector3 PointLoads::total_force() const {
  Vector3 total = Vector3::Zero();
  for (const PointLoad& load : loads_) total += load.force;
  return total;
}

void PointLoads::scatter_to_grid() {
  for (std::vector<PointForce>& forces : forces_) forces.clear();
  for (const PointLoad& load : loads_) {
    const Vector3 shape = particles_of(load.near).quadrature_position(load.near.particle);
    const Vector3 arm = load.point - shape;
    forces_[field_of(load.near)].push_back({{shape[0], shape[1], shape[2]},
                                            {load.force[0], load.force[1], load.force[2]},
                                            {arm[0], arm[1], arm[2]}});
  }
  for (std::size_t field = 0; field < forces_.size(); ++field)
    kernels_.scatter_point_forces(discretisation_.local_view(static_cast<int>(field)),
                                  forces_[field].data(), forces_[field].size());
}

void PointLoads::count_work(double dt, TerrainEnergy& energy) {
  if (loads_.empty()) return;
  loaded_.clear();
  for (const PointLoad& load : loads_) loaded_.push_back(load.near);
  interpolate_motion(loaded_, loaded_motions_);
  for (std::size_t n = 0; n < loads_.size(); ++n) {
    const ParticleMotion& motion = loaded_motions_[n];
    const double work = dt * loads_[n].force.dot(motion.velocity_at(loads_[n].point));
    energy.add_contact_work(work);
    if (loads_[n].work) *loads_[n].work += work;
    remap_.raise_largest_speed(motion.velocity.norm());
  }
  loads_.clear();
}

void PointLoads::interpolate_motion(const std::vector<ParticleIndex>& particles,
                                    std::vector<ParticleMotion>& motions) {
  motions.resize(particles.size());
  if (!remap_.particles_lag()) {
    const double share = remap_.residual_share();
    for (std::size_t n = 0; n < particles.size(); ++n) {
      const Particles& group = particles_of(particles[n]);
      const std::size_t p = particles[n].particle;
      const Vector3 x = group.position(p);
      const Vector3 w = share * group.residual_spin(p);
      Matrix3 turn;
      turn << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
      motions[n] = {x, remap_.interval_running() ? group.quadrature_position(p) : x,
                    group.velocity(p) - share * group.residual_velocity(p), group.affine(p) - turn};
    }
    return;
  }
  for (std::vector<PointMotion>& of_field : grid_motions_) of_field.clear();
  for (const ParticleIndex& particle : particles) {
    std::vector<PointMotion>& of_field = grid_motions_[field_of(particle)];
    Eigen::Map<Vector3>(of_field.emplace_back().quadrature_position) =
        particles_of(particle).quadrature_position(particle.particle);
  }
  for (std::size_t field = 0; field < grid_motions_.size(); ++field)
    kernels_.interpolate_motion(discretisation_.local_view(static_cast<int>(field)),
                                grid_motions_[field].data(), grid_motions_[field].size());
  std::vector<std::size_t> next(grid_motions_.size(), 0);
  for (std::size_t n = 0; n < particles.size(); ++n) {
    const std::size_t field = field_of(particles[n]);
    const PointMotion& grid = grid_motions_[field][next[field]++];
    motions[n].quadrature_position = Eigen::Map<const Vector3>(grid.quadrature_position);
    motions[n].position = particles_of(particles[n]).position(particles[n].particle) +
                          Eigen::Map<const Vector3>(grid.displacement);
    motions[n].velocity = Eigen::Map<const Vector3>(grid.velocity);
    motions[n].affine = Eigen::Map<const Eigen::Matrix<double, 4, 3>>(grid.affine).topRows<3>();
  }
}

}  // namespace furrow

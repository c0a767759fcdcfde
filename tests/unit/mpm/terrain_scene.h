// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Pieces of ground for tests: boxes of one cell length, bodies carved out of them, their sums, and
/// scenes to run.

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "furrow/bodies/coupled_system.h"
#include "furrow/bodies/rigid_plate.h"
#include "furrow/mpm/contact/terrain_contact.h"
#include "furrow/mpm/continuum_terrain.h"
#include "tests/support/checkpoints.h"
#include "tests/support/paths.h"

namespace furrow::testing_terrain {

inline std::shared_ptr<const Material> material_of(const std::string& text) {
  return testing_paths::material_of(text);
}

inline std::string elastic(double E, double nu, double density) {
  std::ostringstream text;
  text.precision(17);
  text << "elastic density " << density << " elasticity linear E " << E << " nu " << nu;
  return text.str();
}

/// Fresh snow of [Shoop2001] Tables 1 and 3 (inputs/materials/fresh_snow.yaml).
inline std::string snow() {
  return "drucker_prager_cap density 200 d 5e3 beta 22.53 R 2.2e-2 eps_vol_pl_0 0.001 elasticity "
         "linear E 13.79e6 nu 0.3 "
         "hardening table p 113.76 5e4 1e5 2e5 5e5 1e6 2e6 2.8e6 3.25e6 "
         "eps_vol_pl 0 0.6419 0.7178 0.8544 0.9933 1.1314 1.3481 1.5041 1.5228 interpolation "
         "linear beyond extrapolate";
}
/// Snow with K0 = 0.12 and cohesion that grows with density: inputs/materials/fresh_snow_cam_clay.
inline std::string crushing_snow() {
  return "cohesive_cam_clay density 200 M 3.3 tension_ratio 0.1 elasticity linear E 13.79e6 nu 0.3 "
         "hardening table p 163.6 29.7e3 118.8e3 594.2e3 1664e3 "
         "eps_vol_pl 0 0.64 0.8471 1.0954 1.4034 interpolation log beyond extrapolate";
}

inline AxisLayout even(double lower, double upper, double cell) {
  return {lower, upper, cell, lower, upper, 1.0};
}

/// Weightless ground that fills a box up to its top; every face is free.
inline TerrainParameters box(const std::shared_ptr<const Material>& material, const Vector3& lower,
                             const Vector3& upper, double cell) {
  TerrainParameters ground;
  ground.x = even(lower.x(), upper.x(), cell);
  ground.y = even(lower.y(), upper.y(), cell);
  ground.z = even(lower.z(), upper.z(), cell);
  ground.surface = upper.z();
  ground.layers = {{material, upper.z() - lower.z()}};
  ground.boundary.fill(BoundaryKind::free);
  ground.gravity.setZero();
  ground.initial_stress = false;
  return ground;
}

/// In the order of Face.
inline void set_boundary(TerrainParameters& ground, const FaceArray<const char*>& kinds) {
  for (const Face face : all_faces) ground.boundary[face] = boundary_kind(kinds[face]);
}

/// Weightless ground with a trough along x, symmetric about y = 0. Its base is rough, its sides are
/// smooth, and a sheet covers it. The grid goes on above it, to `top`.
/// @param size length, width and depth
inline TerrainParameters ground_with_trough(const std::string& material, const Vector3& size,
                                            double top, const Trough& trough, double cell) {
  TerrainParameters ground = box(material_of(material), {0.0, -0.5 * size.y(), 0.0},
                                 {size.x(), 0.5 * size.y(), size.z()}, cell);
  ground.z = even(0.0, top, cell);
  set_boundary(ground, {"smooth", "smooth", "smooth", "smooth", "rough", "free"});
  ground.surface_mesh = true;
  ground.trough = trough;
  return ground;
}

/// Ground and a plate that may touch it.
struct PressedGround {
  PressedGround(const TerrainParameters& parameters, const PlateGeometry& geometry,
                const Vector3& place)
      : ground(parameters, Communicator()), plate(geometry, place) {
    system.add(plate, "plate");
    system.add(ground, "ground");
  }
  void touch(const ContactParameters& parameters = {}) {
    contact = std::make_unique<TerrainContact>(plate, ground, parameters, false, "foot");
    system.add(*contact, "foot");
  }
  ContinuumTerrain ground;
  RigidPlate plate;
  std::unique_ptr<TerrainContact> contact;
  CoupledSystem system;
};

/// Restores a scene as a script does, each fix where its line stands: the terrain before its
/// contacts exist.
inline void restart(PressedGround& from, PressedGround& to) {
  test::hand_over(from.plate, to.plate);
  test::hand_over(from.ground, to.ground);
  to.touch();
  test::hand_over(*from.contact, *to.contact);
}

/// Calls visit(particles, index) for all particles of this rank.
template <class Visit>
void for_particles(ContinuumTerrain& ground, Visit visit) {
  for (ParticleGroup& group : ground.groups())
    for (std::size_t p = 0; p < group.particles.size(); ++p) visit(group.particles, p);
}

/// Drops all particles but those whose position passes.
template <class Keep>
void carve(ContinuumTerrain& ground, Keep keep) {
  for (ParticleGroup& group : ground.groups()) {
    std::vector<std::size_t> kept;
    for (std::size_t p = 0; p < group.particles.size(); ++p)
      if (keep(group.particles.position(p))) kept.push_back(p);
    group.particles.reorder(kept);
  }
}

/// Gives every particle the velocity v + W (x - about).
inline void set_motion(ContinuumTerrain& ground, const Vector3& v,
                       const Matrix3& W = Matrix3::Zero(), const Vector3& about = Vector3::Zero()) {
  for_particles(ground, [&](Particles& particles, std::size_t p) {
    Eigen::Map<Vector3>(particles.data(column::velocity) + 4 * p) =
        v + W * (particles.position(p) - about);
    for (int d = 0; d < 3; ++d)
      Eigen::Map<Vector3>(particles.data(column::affine) + 12 * p + 4 * d) = W.col(d);
  });
}

inline Matrix3 spin(const Vector3& omega) {
  Matrix3 W;
  W << 0, -omega.z(), omega.y(), omega.z(), 0, -omega.x(), -omega.y(), omega.x(), 0;
  return W;
}

struct Sums {
  double mass = 0.0, kinetic = 0.0;
  Vector3 centre = Vector3::Zero(), momentum = Vector3::Zero(), angular = Vector3::Zero();
};

/// Sums of this rank's particles; the affine velocity counts with D = cell^2/4 of a uniform grid
/// inside.
inline Sums sums_of(ContinuumTerrain& ground) {
  Sums sums;
  Vector3 D;
  for (int a = 0; a < 3; ++a) D[a] = 0.25 * std::pow(ground.grid().axis(a).shortest(), 2);
  for (ParticleGroup& group : ground.groups())
    for (std::size_t p = 0; p < group.particles.size(); ++p) {
      const double m = group.material->density() * group.particles.data(column::volume)[p];
      const Vector3 x = group.particles.position(p), v = group.particles.velocity(p);
      const Matrix3 C = group.particles.affine(p), B = C * D.asDiagonal();
      sums.mass += m;
      sums.centre += m * x;
      sums.momentum += m * v;
      sums.angular +=
          m * (x.cross(v) + Vector3(B(2, 1) - B(1, 2), B(0, 2) - B(2, 0), B(1, 0) - B(0, 1)));
      sums.kinetic += 0.5 * m * (v.squaredNorm() + (C * D.asDiagonal() * C.transpose()).trace());
    }
  sums.centre /= sums.mass;
  return sums;
}

/// Volume average of a state field over the particles that pass.
template <class Where>
double mean_of(ContinuumTerrain& ground, std::size_t state_field, Where where) {
  double sum = 0.0, volume = 0.0;
  for_particles(ground, [&](Particles& particles, std::size_t p) {
    if (!where(particles.position(p))) return;
    const double v =
        particles.data(column::volume)[p] * particles.data(column::state + field::volume_ratio)[p];
    sum += v * particles.data(column::state + state_field)[p];
    volume += v;
  });
  return sum / volume;
}

}  // namespace furrow::testing_terrain

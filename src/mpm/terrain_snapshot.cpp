// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/terrain_snapshot.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include <Eigen/Eigenvalues>

namespace furrow {

namespace {

/// Places of a particle's numbers in the record that ranks exchange.
enum : std::size_t {
  id,
  x,
  initial_position = x + 3,
  v = initial_position + 3,
  layer = v + 3,
  volume,
  density,
  pressure,
  mises,
  vertical,
  compaction,
  plastic_strain,
  principal,
  tension_axis = principal + 3,
  compression_axis = tension_axis + 3,
  length = compression_axis + 3
};

/// An axis has no sign: the one that points up, along x or along y.
Vector3 upward(const Vector3& axis) {
  const double sign = axis.z() != 0.0 ? axis.z() : axis.x() != 0.0 ? axis.x() : axis.y();
  return sign < 0.0 ? Vector3(-axis) : axis;
}

/// Principal stresses and axes as a record has them.
void put_principal(const Vector6& stress, double* record) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(to_matrix(stress));
  Eigen::Map<Vector3>(record + principal) = solver.eigenvalues().reverse();
  Eigen::Map<Vector3>(record + tension_axis) = upward(solver.eigenvectors().col(2));
  Eigen::Map<Vector3>(record + compression_axis) = upward(solver.eigenvectors().col(0));
}

/// Column of the material's compaction, or that of the volume ratio.
std::size_t compaction_column(const Material& material) {
  return column::state + material.find_field("eps_vol_pl").value_or(field::volume_ratio);
}

}  // namespace

TerrainSnapshot take_snapshot(ContinuumTerrain& terrain) {
  std::vector<double> records;
  const std::vector<ParticleGroup>& groups = terrain.groups();
  for (const ParticleGroup& group : groups) {
    const Particles& particles = group.particles;
    const std::size_t compacted = compaction_column(*group.material);
    const std::optional<std::size_t> sheared = group.material->find_field("eps_dev_pl");
    for (std::size_t p = 0; p < particles.size(); ++p) {
      double r[length];
      Vector6 stress;
      for (int s = 0; s < 6; ++s)
        stress[s] = particles.data(column::state + field::stress + static_cast<std::size_t>(s))[p];
      const Invariants invariant = invariants(stress);
      const double ratio = particles.volume_ratio(p);
      const double value = particles.data(compacted)[p];
      r[id] = particles.data(column::id)[p];
      for (std::size_t a = 0; a < 3; ++a) {
        r[x + a] = particles.data(column::x + a)[p];
        r[initial_position + a] = particles.data(column::initial_x + a)[p];
        r[v + a] = particles.data(column::velocity)[4 * p + a];
      }
      r[layer] = static_cast<double>(group.layer);
      r[volume] = particles.data(column::volume)[p] * ratio;
      r[density] = group.material->density() / ratio;
      r[pressure] = invariant.p;
      r[mises] = invariant.q;
      r[vertical] = stress[2];
      put_principal(stress, r);
      r[compaction] = compacted == column::state + field::volume_ratio ? -std::log(value) : value;
      r[plastic_strain] = sheared ? particles.data(column::state + *sheared)[p] : 0.0;
      records.insert(records.end(), r, r + length);
    }
  }
  records = terrain.ranks().gather_to_first(records);
  const std::size_t count = records.size() / length;
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return records[a * length] < records[b * length];
  });

  TerrainSnapshot snapshot;
  const std::pair<Matrix3X*, std::size_t> vectors[] = {
      {&snapshot.x, x},
      {&snapshot.initial_position, initial_position},
      {&snapshot.v, v},
      {&snapshot.principal_stress, principal},
      {&snapshot.tension_axis, tension_axis},
      {&snapshot.compression_axis, compression_axis}};
  for (auto [columns, at] : vectors) columns->resize(3, static_cast<Eigen::Index>(count));
  for (std::size_t n = 0; n < count; ++n) {
    const double* r = records.data() + order[n] * length;
    for (auto [columns, at] : vectors)
      columns->col(static_cast<Eigen::Index>(n)) = Eigen::Map<const Vector3>(r + at);
    for (auto [values, at] :
         {std::pair{&snapshot.id, id}, std::pair{&snapshot.layer, layer},
          std::pair{&snapshot.volume, volume}, std::pair{&snapshot.density, density},
          std::pair{&snapshot.pressure, pressure}, std::pair{&snapshot.mises, mises},
          std::pair{&snapshot.vertical_stress, vertical},
          std::pair{&snapshot.compaction, compaction},
          std::pair{&snapshot.plastic_strain, plastic_strain}})
      values->push_back(r[at]);
  }
  return snapshot;
}

std::vector<RutPoint> collect_rut(const ContinuumTerrain& terrain) {
  return terrain.rut().gather(terrain.ranks());
}

}  // namespace furrow

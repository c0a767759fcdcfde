// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Material points of one law, column by column.

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "material/material.h"
#include "material/point_block.h"
#include "mpm/transfer.h"

namespace furrow {

/// Columns every particle has; those of the law's state follow, then those that others keep with
/// the particles.
namespace column {
enum : std::size_t {
  x,
  y,
  z,         ///< position [m]
  velocity,  ///< [m/s] four numbers, the last is unused
  affine,    ///< C [1/s], three columns of four numbers
  volume,    ///< in the reference configuration [m^3]
  shape_x,
  shape_y,
  shape_z,  ///< position where the weights are taken (continuum_terrain.h) [m]
  initial_x,
  initial_y,
  initial_z,  ///< position at the start [m]
  half_x,
  half_y,
  half_z,  ///< half the spacing of the particles at the start [m]
  id,      ///< whole numbers, unique in a ground
  state    ///< first of the law's state fields
};
}

class Particles {
 public:
  explicit Particles(const Material& material);

  /// Keeps a number of values with every particle, zero at first. @return the column
  std::size_t add_column(const std::string& name, int components);

  std::size_t size() const { return size_; }
  std::size_t column_count() const { return columns_.size(); }
  std::size_t record_length() const;  ///< numbers of one particle
  double* data(std::size_t column) { return columns_[column].values.data(); }
  const double* data(std::size_t column) const { return columns_[column].values.data(); }
  Vector3 position(std::size_t i) const {
    return {data(column::x)[i], data(column::y)[i], data(column::z)[i]};
  }
  Vector3 shape_position(std::size_t i) const {
    return {data(column::shape_x)[i], data(column::shape_y)[i], data(column::shape_z)[i]};
  }
  Vector3 velocity(std::size_t i) const {
    return Eigen::Map<const Vector3>(data(column::velocity) + 4 * i);
  }
  Matrix3 affine(std::size_t i) const;

  /// Appends particles, all zero. @return the first
  std::size_t append(std::size_t count);
  void set_state(std::size_t i, const VectorX& state);
  VectorX state(std::size_t i) const;

  /// Particle i becomes what particle order[i] was; those not named are dropped.
  void reorder(const std::vector<std::size_t>& order);
  void pack(std::size_t i, std::vector<double>& buffer) const;  ///< appends record_length() numbers
  void unpack(const double* record);                            ///< appends a particle

  ParticleView view(std::size_t first, std::size_t count);
  /// State pointers of a block that begins at a particle; valid until the number of particles
  /// changes.
  void state_pointers(std::size_t first, std::vector<double*>& pointers);

 private:
  struct Column {
    std::string name;
    int components;
    std::vector<double> values;
  };
  std::vector<Column> columns_;
  std::vector<double> scratch_;
  std::size_t size_ = 0, state_fields_;
};

}  // namespace furrow

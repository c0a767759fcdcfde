// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Material points of one material, column by column (structure of arrays).

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/material/material.h"
#include "furrow/material/point_block.h"
#include "furrow/mpm/transfer/transfer.h"

namespace furrow {

/// Columns of every particle; those of the material's state follow. Unscoped: columns are indices,
/// and those of the state are sums (column::state + field::stress). One number for each particle
/// unless said otherwise. Contacts add columns (ParticleColumn).
namespace column {
enum : std::size_t {
  x,
  y,
  z,         ///< position [m]
  velocity,  ///< four numbers, the last is unused [m/s]
  affine,    ///< C, three columns of four numbers [1/s]
  /// residual motion, which the grid did not take when the interval began (terrain_step.h), as
  /// velocity [m/s] and spin [1/s]: four numbers each, the last unused
  residual,
  volume,  ///< in the reference configuration [m^3]
  quadrature_x,
  quadrature_y,
  quadrature_z,  ///< quadrature position of the weights (terrain_step.h) [m]
  initial_x,
  initial_y,
  initial_z,  ///< position at the start [m]
  half_x,
  half_y,
  half_z,  ///< half the spacing of the particles at the start [m]
  id,      ///< whole numbers, unique in a terrain
  cell,    ///< where the particle was at the last sorting, a whole number for each cell
  state    ///< first field of the material's state
};
}

class Particles {
  struct Column {
    int components;  // numbers of one particle
    std::vector<double> values;
  };
  struct AddedColumn : Column {
    enum class Owner { absent, present, gone };  // absent: a checkpoint brought the values
    std::string name;                            // of the owner
    Owner owner;
    bool (*idle)(const double* values);
  };

 public:
  /// Handle of a column that a contact adds to the particles; the column lives as long as the
  /// handle. The handle may outlive the particles.
  class AddedValues {
   public:
    AddedValues(AddedValues&&) = default;
    AddedValues& operator=(AddedValues&&) = delete;
    ~AddedValues();
    double* data() const { return column_->values.data(); }

   private:
    friend class Particles;
    explicit AddedValues(std::shared_ptr<AddedColumn> column);
    std::shared_ptr<AddedColumn> column_;  // empty after a move
  };

  explicit Particles(const Material& material);
  Particles(Particles&&) = default;
  Particles& operator=(Particles&&) = default;

  /// Adds a column: values that follow each particle through sorting, migration and checkpoints.
  /// The values are zero, or those that a checkpoint has for this owner.
  /// @param owner  names who adds the column: "fix contact/continuum 'touch'"
  /// @param components  values of one particle
  /// @throws Error when the owner has a column already, or the checkpoint's has another length
  /// @param idle  whether a particle with these values may be divided or united with another;
  /// null: always
  AddedValues add_column(const std::string& owner, int components,
                         bool (*idle)(const double* values) = nullptr);
  /// Removes the columns whose handles are gone; on every rank at the same time, because ranks
  /// exchange records of record_length().
  void remove_released_columns();
  /// Saves the owners and lengths of the added columns. A terrain is restored before the contacts
  /// that press on it: the columns then wait for add_column().
  void checkpoint_columns(Checkpoint& state);

  std::size_t size() const { return size_; }
  std::size_t record_length() const;  ///< numbers of one particle
  /// Place of a column's first number in a record.
  static std::size_t place_in_record(std::size_t column);
  double* data(std::size_t column) { return columns_[column].values.data(); }
  const double* data(std::size_t column) const { return columns_[column].values.data(); }
  Vector3 position(std::size_t i) const { return vector(column::x, i); }
  Vector3 quadrature_position(std::size_t i) const { return vector(column::quadrature_x, i); }
  Vector3 half_spacing(std::size_t i) const { return vector(column::half_x, i); }
  Vector3 velocity(std::size_t i) const {
    return Eigen::Map<const Vector3>(data(column::velocity) + 4 * i);
  }
  Matrix3 affine(std::size_t i) const;
  Vector3 residual_velocity(std::size_t i) const {
    return Eigen::Map<const Vector3>(data(column::residual) + 8 * i);
  }
  Vector3 residual_spin(std::size_t i) const {
    return Eigen::Map<const Vector3>(data(column::residual) + 8 * i + 4);
  }
  /// J = V/V0
  double volume_ratio(std::size_t i) const { return data(column::state + field::volume_ratio)[i]; }

  /// Appends particles, all zero. @return the first
  std::size_t append(std::size_t count);
  void set_state(std::size_t i, const VectorX& state);
  VectorX state(std::size_t i) const;

  /// False if the owner of an added column needs the particle as it is.
  bool is_idle(std::size_t i) const;
  /// Appends a copy of a particle. @return its index
  std::size_t duplicate(std::size_t i);
  /// A particle gets the means of its values and another one's; added columns stay.
  void average(std::size_t i, std::size_t other);

  /// Particle i becomes what particle order[i] was; those not named are removed.
  void reorder(const std::vector<std::size_t>& order);
  /// Appends the record_length() numbers of a particle to a buffer; the first three are its
  /// position.
  void pack(std::size_t i, std::vector<double>& buffer) const;
  void unpack(const double* record);  ///< appends a particle
  void reserve(std::size_t count);    ///< memory for as many particles
  void clear();                       ///< removes all particles and frees their memory

  /// Valid until the number or the order of the particles changes.
  ParticleView view(std::size_t first, std::size_t count);
  ParticleView view() { return view(0, size_); }
  /// State pointers of a block that begins at a particle; valid as long as a view.
  void state_pointers(std::size_t first, std::vector<double*>& pointers);

 private:
  void reorder_some(const std::vector<std::size_t>& order, std::size_t first, std::size_t last);
  static std::vector<double> rows_of(const Column& column, const std::vector<std::size_t>& order,
                                     std::size_t first, std::size_t last);
  std::vector<double> zeros(int components) const {
    return std::vector<double>(size_ * static_cast<std::size_t>(components), 0.0);
  }
  template <class Visit>
  void for_each_column(Visit&& visit) {
    for (Column& column : columns_) visit(column);
    for (const std::shared_ptr<AddedColumn>& column : added_) visit(*column);
  }
  template <class Visit>
  void for_each_column(Visit&& visit) const {
    for (const Column& column : columns_) visit(column);
    for (const std::shared_ptr<AddedColumn>& column : added_)
      visit(static_cast<const Column&>(*column));
  }
  /// Vector of a particle in three columns that follow one another.
  Vector3 vector(std::size_t first_column, std::size_t i) const {
    return {data(first_column)[i], data(first_column + 1)[i], data(first_column + 2)[i]};
  }

  std::vector<Column> columns_;
  std::vector<std::shared_ptr<AddedColumn>> added_;  // each shared with its handle, if there is one
  std::vector<double> scratch_;                      // of a column with one component
  std::size_t size_ = 0;
  std::size_t state_fields_;
};

using ParticleColumn = Particles::AddedValues;

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The ground of the soil contact model: the height of its surface on a grid of square cells.

#include <string>
#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/core/options/options.h"
#include "furrow/core/types.h"
#include "furrow/geometry/ground_relief.h"
#include "furrow/geometry/surface.h"

namespace furrow {

struct HeightFieldParameters {
  double length = 0.0;               ///< along x [m]
  double width = 0.0;                ///< along y [m]
  Vector2 centre = Vector2::Zero();  ///< [m]
  double level = 0.0;                ///< z of the undisturbed surface [m]
  double cell = 0.0;                 ///< [m]
  GroundRelief relief = {};          ///< of the undisturbed surface above the level
};

/// The keys of a height field without those of its relief.
void declare_height_field(Schema& schema);
HeightFieldParameters height_field_from(const Options& options);

/// A cell has two heights. Its surface is where a body meets it. Sinkage counts from its
/// reference, which rises with soil that flows there. Their difference is the permanent sinkage.
/// Cells are numbered x fastest. The field is replicated on every rank.
class HeightField {
 public:
  /// @param where names the ground in errors @throws InputError
  explicit HeightField(const HeightFieldParameters& parameters,
                       const std::string& where = "height field");

  const HeightFieldParameters& parameters() const { return parameters_; }
  double cell() const { return parameters_.cell; }
  double cell_area() const { return parameters_.cell * parameters_.cell; }
  int columns() const { return columns_; }  ///< along x
  int rows() const { return rows_; }        ///< along y
  std::size_t cells() const { return surface_.size(); }
  const Vector2& lower() const { return lower_; }  ///< corner of the lowest x and y [m]
  Vector2 upper() const { return lower_ + cell() * Vector2(columns_, rows_); }
  double highest() const { return highest_; }  ///< highest surface of a cell so far [m]
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  Vector2 centre(std::size_t cell) const {
    const auto columns = static_cast<std::size_t>(columns_);
    return lower_ + this->cell() * Vector2(static_cast<double>(cell % columns) + 0.5,
                                           static_cast<double>(cell / columns) + 0.5);
  }

  double surface(std::size_t cell) const { return surface_[cell]; }  ///< [m]
  /// Height of the surface at a place in the field, linear between the middles of cells [m].
  double height(const Vector2& place) const;
  /// @throws StateError always: a body is at this place beyond the field
  [[noreturn]] void refuse_edge(const Vector2& place) const;
  double reference(std::size_t cell) const { return reference_[cell]; }  ///< [m]
  /// Presses the surface of a cell down to a height [m].
  void press(std::size_t cell, double height) { surface_[cell] = height; }
  /// Puts soil of this height [m] on a cell next to a rut. Soil steeper than the angle of repose
  /// moves on, away from the rut. Keeps the volume.
  /// @param direction  away from the rut: 1 or -1 along y @param slope  tangent of that angle
  void deposit(int column, int row, int direction, double height, double slope);

  double deepest() const;       ///< largest permanent sinkage [m]
  double volume_above() const;  ///< of soil above the undisturbed level [m^3]
  double volume_below() const;  ///< of ruts below that level [m^3]
  Surface triangles() const;    ///< the surface, a node at the centre of each cell
  void checkpoint(Checkpoint& state);

 private:
  void raise(std::size_t cell, double height);
  double undisturbed(std::size_t cell) const {
    return undisturbed_.empty() ? parameters_.level : undisturbed_[cell];
  }

  HeightFieldParameters parameters_;
  Vector2 lower_ = Vector2::Zero();
  int columns_ = 0, rows_ = 0;
  double highest_ = 0.0;
  std::vector<double> surface_, reference_;  // of each cell [m]
  std::vector<double> undisturbed_;          // heights at the start; empty on flat ground
};

}  // namespace furrow

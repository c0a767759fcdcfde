// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Grains as files store them: the data for pictures, tables and displacements of a bed of spheres.

#include <cstdint>
#include <limits>
#include <vector>

#include "furrow/core/types.h"

namespace furrow {

/// The spheres of a bed at one instant, in any order; SI units.
struct Grains {
  std::vector<std::int64_t> id;  ///< id of a grain, constant over time
  Matrix3X x;                    ///< [m]   3 x grains, inside the box where it is periodic
  Matrix3X v;                    ///< [m/s] 3 x grains
  VectorX radius;                ///< [m]
  /// [J] 3 x grains, or none where it is not known: xx, yy and zz of stress times volume from the
  /// contacts between grains, half of force times distance of the centres each, tension positive
  Matrix3X virial;
  /// [m] length of the box along each periodic axis, 0 where it is not periodic
  Vector3 period = Vector3::Zero();
  /// [m] height of the untouched bed's surface, where known
  double bed_level = std::numeric_limits<double>::quiet_NaN();

  std::size_t size() const { return id.size(); }
  void resize(std::size_t grains);  ///< all arrays but virial, zeroed

  /// Displacement of every grain since the reference was taken, 3 x grains [m]: matched by id,
  /// shortest way round a periodic box. A grain that the reference lacks has moved by NaN.
  Matrix3X displacement_from(const Grains& reference) const;
  /// Shift [m] from a place to its image nearest to the middle of these grains, for a body that
  /// goes round and round in a periodic box. Zero where there are no grains.
  Vector3 shift_to_image(const Vector3& place) const;
  /// @throws StateError when the arrays differ in length, an id is there twice, or a number is not
  /// finite
  void check() const;
};

}  // namespace furrow

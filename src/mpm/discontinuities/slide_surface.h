// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A surface inside of the ground on which one part of it slides on the other.

#include <cstddef>
#include <variant>

#include "furrow/core/types.h"

namespace furrow {

/// Plane whose normal points away from the inner side.
struct SlidePlane {
  Vector3 point;   ///< [m]
  Vector3 normal;  ///< of length 1
};

/// Upright cylinder, as high as the ground.
struct SlideCylinder {
  double x, y;    ///< of the axis [m]
  double radius;  ///< [m]
};

/// Four upright walls along x and y, as high as the ground.
struct SlideBox {
  double x, y;           ///< of the middle [m]
  double length, width;  ///< along x and y [m]
};

/// The surface is fixed in space. Ground belongs for good to the side where it was at the start.
struct SlideSurface {
  std::variant<SlidePlane, SlideCylinder, SlideBox> shape;
  double friction = 0.0;  ///< coefficient of Coulomb's law

  /// Side of a place: 0 inside, 1 outside. @param x  of undisturbed ground [m]
  std::size_t side(const Vector3& x) const;
  /// Normal from the inner to the outer side, at the point of the surface next to x; of length 1.
  Vector3 normal(const Vector3& x) const;
};

}  // namespace furrow

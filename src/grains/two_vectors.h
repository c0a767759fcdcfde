// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Two vectors that obey the same equations, component by component, so that one instruction of the
/// processor does both.

#include "furrow/core/types.h"

namespace furrow {

/// One component of two vectors.
using Two [[gnu::vector_size(16)]] = double;

struct TwoVectors {
  Two x = {0.0, 0.0}, y = {0.0, 0.0}, z = {0.0, 0.0};

  static TwoVectors of(const Vector3& first, const Vector3& second) {
    return {Two{first[0], second[0]}, Two{first[1], second[1]}, Two{first[2], second[2]}};
  }
  /// Loads two vectors from six numbers, as store() writes them.
  static TwoVectors load(const double* values) {
    return {Two{values[0], values[1]}, Two{values[2], values[3]}, Two{values[4], values[5]}};
  }
  void store(double* values) const {
    for (const Two& two : {x, y, z}) {
      *values++ = two[0];
      *values++ = two[1];
    }
  }
  Vector3 first() const { return {x[0], y[0], z[0]}; }
  Vector3 second() const { return {x[1], y[1], z[1]}; }
  Two squared() const { return x * x + y * y + z * z; }
};

inline TwoVectors operator+(const TwoVectors& a, const TwoVectors& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline TwoVectors operator-(const TwoVectors& a, const TwoVectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
/// Each vector times its number.
inline TwoVectors operator*(const Two& factors, const TwoVectors& a) {
  return {factors * a.x, factors * a.y, factors * a.z};
}
inline TwoVectors operator*(double factor, const TwoVectors& a) { return Two{factor, factor} * a; }
/// One vector times each number.
inline TwoVectors times(const Two& factors, const Vector3& n) {
  return {factors * n[0], factors * n[1], factors * n[2]};
}
inline Two dot(const Vector3& n, const TwoVectors& a) {
  return n[0] * a.x + n[1] * a.y + n[2] * a.z;
}
inline TwoVectors cross(const Vector3& n, const TwoVectors& a) {
  return {n[1] * a.z - n[2] * a.y, n[2] * a.x - n[0] * a.z, n[0] * a.y - n[1] * a.x};
}

}  // namespace furrow

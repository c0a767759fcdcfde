// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Vectors of several elements at once.

#include "furrow/simd/lanes.h"

namespace furrow {
inline namespace FURROW_ISA {

/// A vector of three numbers for each lane.
struct Triple {
  Lanes x, y, z;
};
FURROW_INLINE Triple operator+(const Triple& a, const Triple& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
FURROW_INLINE Triple operator-(const Triple& a, const Triple& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
FURROW_INLINE Triple operator*(const Lanes& s, const Triple& a) {
  return {s * a.x, s * a.y, s * a.z};
}
FURROW_INLINE Lanes dot(const Triple& a, const Triple& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
FURROW_INLINE Triple cross(const Triple& a, const Triple& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// values[stride index + offset] of each lane's own index.
FURROW_INLINE Lanes gather(const double* values, const int* index, int stride, int offset) {
  return Lanes([&](auto lane) { return values[stride * index[lane] + offset]; });
}

}  // namespace FURROW_ISA
}  // namespace furrow

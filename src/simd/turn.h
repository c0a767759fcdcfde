// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Rotations of several elements at once, as unit quaternions.

#include "furrow/simd/triple.h"

namespace furrow {
inline namespace FURROW_ISA {

/// Quaternion of a turn: (x, y, z) = sin(angle/2) axis, w = cos(angle/2).
struct Turn {
  Lanes x, y, z, w;
};
/// Turn by b, then by a.
FURROW_INLINE Turn operator*(const Turn& a, const Turn& b) {
  return {
      a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
      a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
FURROW_INLINE Turn conjugate(const Turn& a) { return {-a.x, -a.y, -a.z, a.w}; }

FURROW_INLINE Turn normalised(const Turn& a) {
  const Lanes inverse = Lanes(1.0) / sqrt(a.x * a.x + a.y * a.y + a.z * a.z + a.w * a.w);
  return {inverse * a.x, inverse * a.y, inverse * a.z, inverse * a.w};
}

/// Quaternion of a rotation matrix with columns c, by a quaternion p that is less than half a turn
/// from it: 4 q q^T, which is linear in the matrix, times p is 4 (q . p) q.
FURROW_INLINE Turn turn_of(const Triple (&c)[3], const Turn& p) {
  const Lanes one = 1.0;
  const Lanes xx = one + c[0].x - c[1].y - c[2].z, yy = one - c[0].x + c[1].y - c[2].z,
              zz = one - c[0].x - c[1].y + c[2].z, ww = one + c[0].x + c[1].y + c[2].z;
  const Lanes xy = c[1].x + c[0].y, xz = c[2].x + c[0].z, yz = c[2].y + c[1].z;
  const Lanes xw = c[1].z - c[2].y, yw = c[2].x - c[0].z, zw = c[0].y - c[1].x;
  return normalised(
      {xx * p.x + xy * p.y + xz * p.z + xw * p.w, xy * p.x + yy * p.y + yz * p.z + yw * p.w,
       xz * p.x + yz * p.y + zz * p.z + zw * p.w, xw * p.x + yw * p.y + zw * p.z + ww * p.w});
}

}  // namespace FURROW_ISA
}  // namespace furrow

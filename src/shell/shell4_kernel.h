// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The co-rotational shell, several elements at once. Included by kernel units only (simd/lanes.h
/// says why).
///
/// An element's axes e turn with its nodes: e_3 is normal to both medians, and the turn about e_3
/// is that of the polar decomposition of the medians' deformation, so the axes do not depend on
/// where the numbering starts. In them
///   u_a     = e^T (x_a - c) - X_a,
///   theta_a = 2 sin(angle/2) axis  of  T_a = e^T Q_a E   (E: stress-free axes, Q_a: rotation of
///   the node)
/// are small, whatever the shell does, and U = 1/2 u^T K u. Forces are the exact gradient of U,
/// with the turning of the axes in it: they balance in force and moment, and a free shell keeps its
/// energy (Nour-Omid & Rankin 1991).

#include "shell/shell4_block.h"
#include "simd/lanes.h"

namespace furrow {
inline namespace FURROW_ISA {

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
FURROW_INLINE Lanes gather(const double* values, const int* index, int stride, int offset) {
  return Lanes([&](auto lane) { return values[stride * index[lane] + offset]; });
}
FURROW_INLINE Lanes load(const double* values) { return Lanes(values, stdx::element_aligned); }

/// Frame of the element now, and how it turns with the medians.
struct Frame {
  Triple e1, e2, e3;
  Lanes a1, a2, b1, b2;  // medians in e
  Lanes area, trace;     // of the medians' parallelogram; of their stretch

  FURROW_INLINE Frame(const Triple& a, const Triple& b, const Shell4Kind& kind) {
    const Triple normal = cross(a, b);
    area = sqrt(dot(normal, normal));
    const Lanes length = sqrt(dot(a, a));
    e3 = Lanes(1.0) / area * normal;
    const Triple t1 = Lanes(1.0) / length * a, t2 = cross(e3, t1);
    const Lanes bt1 = dot(b, t1), bt2 = dot(b, t2);
    // F11 + F22, F21 - F12
    const Lanes even = length * kind.p1 + bt2 * kind.q2, odd = -(length * kind.p2 + bt1 * kind.q2);
    trace = sqrt(even * even + odd * odd);
    const Lanes c = even / trace, s = odd / trace;
    e1 = c * t1 + s * t2;
    e2 = c * t2 - s * t1;
    a1 = c * length;
    a2 = -s * length;
    b1 = c * bt1 + s * bt2;
    b2 = c * bt2 - s * bt1;
  }
  FURROW_INLINE Triple local(const Triple& v) const { return {dot(e1, v), dot(e2, v), dot(e3, v)}; }
  FURROW_INLINE Triple space(const Triple& v) const { return v.x * e1 + v.y * e2 + v.z * e3; }
};

inline Shell4Result shell4_forces(const Shell4Kind* kinds, std::size_t kind_count,
                                  const Shell4Places& places, const double* x,
                                  const double* rotation, double pressure, double* force,
                                  double* moment) {
  constexpr double xi[4] = {-1, 1, 1, -1}, eta[4] = {-1, -1, 1, 1};
  Shell4Result result;
  Lanes energy = 0.0, volume = 0.0;
  for (std::size_t k = 0; k < kind_count; ++k) {
    const Shell4Kind& kind = kinds[k];
    for (std::size_t i = kind.first; i < kind.end; i += lane_count) {
      Lanes weight([&](auto lane) { return places.active[i + lane] ? 1.0 : 0.0; });
      Triple node[4];
      for (int n = 0; n < 4; ++n) {
        const int* index = places.node[n] + i;
        node[n] = {gather(x, index, 3, 0), gather(x, index, 3, 1), gather(x, index, 3, 2)};
      }
      const Triple centre = Lanes(0.25) * (node[0] + node[1] + (node[2] + node[3]));
      const Triple a = Lanes(0.5) * (node[1] + node[2] - (node[0] + node[3]));
      const Triple b = Lanes(0.5) * (node[2] + node[3] - (node[0] + node[1]));
      const Frame frame(a, b, kind);

      Lanes u[24], f[24];
      Triple arm[4], half_turn[4];
      Lanes cosine[4];  // of half the turn
      Lanes straightest = 4.0;
      for (int n = 0; n < 4; ++n) {
        arm[n] = frame.local(node[n] - centre);
        u[6 * n] = arm[n].x - kind.x[n][0];
        u[6 * n + 1] = arm[n].y - kind.x[n][1];
        u[6 * n + 2] = arm[n].z - kind.x[n][2];
        Triple column[3];  // of the turn T: local axes of Q E
        const int* index = places.node[n] + i;
        Lanes Q[9];
        for (int entry = 0; entry < 9; ++entry) Q[entry] = gather(rotation, index, 9, entry);
        for (int c = 0; c < 3; ++c) {
          const Lanes E0 = load(places.axes[3 * c] + i), E1 = load(places.axes[3 * c + 1] + i),
                      E2 = load(places.axes[3 * c + 2] + i);
          column[c] =
              frame.local({Q[0] * E0 + Q[3] * E1 + Q[6] * E2, Q[1] * E0 + Q[4] * E1 + Q[7] * E2,
                           Q[2] * E0 + Q[5] * E1 + Q[8] * E2});
        }
        const Lanes four_cos2 = Lanes(1.0) + column[0].x + column[1].y + column[2].z;
        straightest = min(straightest, four_cos2);
        const Lanes two_cos = sqrt(four_cos2), inverse = Lanes(1.0) / two_cos;
        const Triple turn = inverse * Triple{column[1].z - column[2].y, column[2].x - column[0].z,
                                             column[0].y - column[1].x};
        cosine[n] = Lanes(0.5) * two_cos;
        half_turn[n] = Lanes(0.5) * turn;
        u[6 * n + 3] = turn.x;
        u[6 * n + 4] = turn.y;
        u[6 * n + 5] = turn.z;
      }
      // four sums at once: their additions need not wait for each other
      for (int row = 0; row < 24; row += 4) {
        Lanes sum0 = 0.0, sum1 = 0.0, sum2 = 0.0, sum3 = 0.0;
        for (int c = 0; c < 24; ++c) {
          sum0 += kind.stiffness[row][c] * u[c];
          sum1 += kind.stiffness[row + 1][c] * u[c];
          sum2 += kind.stiffness[row + 2][c] * u[c];
          sum3 += kind.stiffness[row + 3][c] * u[c];
        }
        f[row] = sum0;
        f[row + 1] = sum1;
        f[row + 2] = sum2;
        f[row + 3] = sum3;
      }
      Lanes twice = 0.0;
      for (int row = 0; row < 24; ++row) twice += u[row] * f[row];
      energy += weight * (Lanes(0.5) * twice);

      // From the gradient in u to forces and moments, with the moment that the axes' turning has to
      // carry.
      Triple nodal[4], couple[4], carried = {0.0, 0.0, 0.0}, mean = {0.0, 0.0, 0.0};
      for (int n = 0; n < 4; ++n) {
        nodal[n] = {f[6 * n], f[6 * n + 1], f[6 * n + 2]};
        const Triple m = {f[6 * n + 3], f[6 * n + 4], f[6 * n + 5]};
        couple[n] = cosine[n] * m + cross(half_turn[n], m);
        carried = carried + cross(arm[n], nodal[n]) + couple[n];
        mean = mean + Lanes(0.25) * nodal[n];
      }
      const Lanes per_area = Lanes(1.0) / frame.area, about3 = carried.z / frame.trace;
      const Triple on_a = {-kind.p2 * about3, kind.p1 * about3,
                           -per_area * (frame.b1 * carried.x + frame.b2 * carried.y)};
      const Triple on_b = {-kind.q2 * about3, 0.0,
                           per_area * (frame.a1 * carried.x + frame.a2 * carried.y)};

      const Triple A = Lanes(0.5) * a, B = Lanes(0.5) * b;
      const Triple C = Lanes(0.25) * (node[0] - node[1] + (node[2] - node[3]));
      const Triple AB = cross(A, B), AC = Lanes(1.0 / 3.0) * cross(A, C),
                   CB = Lanes(1.0 / 3.0) * cross(C, B);
      for (int n = 0; n < 4; ++n) {
        const Triple push = AB + xi[n] * AC + eta[n] * CB;
        volume += weight * (dot(push, node[n]) * Lanes(1.0 / 3.0));
        const Triple gradient =
            nodal[n] - mean - (Lanes(0.5 * xi[n]) * on_a + Lanes(0.5 * eta[n]) * on_b);
        const Triple on_node = pressure * push - frame.space(gradient),
                     turning = frame.space(couple[n]);
        for (int lane = 0; lane < lane_count; ++lane) {
          if (!places.active[i + static_cast<std::size_t>(lane)]) continue;
          const int index = 3 * places.node[n][i + static_cast<std::size_t>(lane)];
          force[index] += on_node.x[lane];
          force[index + 1] += on_node.y[lane];
          force[index + 2] += on_node.z[lane];
          moment[index] -= turning.x[lane];
          moment[index + 1] -= turning.y[lane];
          moment[index + 2] -= turning.z[lane];
        }
      }
      if (any(!(straightest >= Lanes(result.straightest))))
        for (int lane = 0; lane < lane_count; ++lane)
          if (!(straightest[lane] >= result.straightest)) {
            result.straightest = straightest[lane];
            result.worst_place = i + static_cast<std::size_t>(lane);
          }
    }
  }
  for (int lane = 0; lane < lane_count; ++lane) {
    result.energy += energy[lane];
    result.volume += volume[lane];
  }
  result.finite = result.energy - result.energy == 0.0 && result.straightest == result.straightest;
  return result;
}

constexpr void fill(Shell4Kernels& kernels) { kernels.forces = shell4_forces; }

}  // namespace FURROW_ISA
}  // namespace furrow

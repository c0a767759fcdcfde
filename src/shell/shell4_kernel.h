// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The co-rotational shell, several elements at once. Included by kernel units only (simd/lanes.h
/// explains why).
///
/// The element-independent co-rotational formulation [Rankin1986, NourOmid1991] (theory: tyres, eq.
/// 1) around the linear element of shell4_stiffness.h, in the steps of shell4_forces():
///
///   frame        The axes e of the element follow its nodes. Axis e_3 is normal to both medians.
///                The rotation about e_3 comes from the polar decomposition of the deformation of
///                the medians, which does not depend on the numbering of the nodes. Shell4Turning
///                can choose the first median instead.
///   deformation  Displacements and rotations are small in these axes for any motion of the shell.
///                  u_a     = e^T (x_a - c) - X_a.
///                  theta_a = 2 sin(angle/2) axis  of  T_a = e^T Q_a E.
///                The mean of the nodes is c. X_a and E are nodes and axes without stress. Q_a is
///                the rotation of the node, and T_a is a product of quaternions.
///   energy       U = 1/2 u^T K u, with the gradient K u.
///   forces       The exact gradient of U, with the rotation of the axes. The forces balance in
///                force and moment, so a free shell keeps its energy.
///   pressure     A follower load on the bilinear surface through the nodes.
///   scatter      Adds the forces to the nodes, one element after the other.

#include "furrow/shell/shell4_block.h"
#include "furrow/simd/records.h"
#include "furrow/simd/turn.h"

namespace furrow {
inline namespace FURROW_ISA {

// Parameter coordinates of the nodes.
constexpr double shell4_xi[4] = {-1, 1, 1, -1};
constexpr double shell4_eta[4] = {-1, -1, 1, 1};

/// Nodes of the elements now, their mean and medians: a from edge 4-1 to edge 2-3, b from edge 1-2
/// to edge 3-4 [m].
struct Quadrilateral {
  Triple node[4];
  Triple centre;
  Triple a, b;

  FURROW_INLINE Quadrilateral(const Shell4Places& places, std::size_t first, const double* x) {
    for (int n = 0; n < 4; ++n) {
      const int* index = places.node[n] + first;
      Lanes numbers[4];
      to_lanes([&](int lane) { return load_triple(x + 3 * index[lane]); }, numbers);
      node[n] = {numbers[0], numbers[1], numbers[2]};
    }
    centre = Lanes(0.25) * (node[0] + node[1] + (node[2] + node[3]));
    a = Lanes(0.5) * (node[1] + node[2] - (node[0] + node[3]));
    b = Lanes(0.5) * (node[2] + node[3] - (node[0] + node[1]));
  }
};

/// The element's axes e now, and how they rotate with the medians.
struct Frame {
  Triple e1, e2, e3;
  Lanes a1, a2, b1, b2;  // medians in e [m]
  Lanes area;            // of the medians' parallelogram [m^2]
  Lanes trace;           // of the medians' stretch

  FURROW_INLINE Frame(const Triple& a, const Triple& b, const Shell4Kind& kind) {
    const Triple normal = cross(a, b);
    area = sqrt(dot(normal, normal));
    const Lanes length = sqrt(dot(a, a));
    e3 = Lanes(1.0) / area * normal;
    const Triple t1 = Lanes(1.0) / length * a;
    const Triple t2 = cross(e3, t1);
    const Lanes bt1 = dot(b, t1);
    const Lanes bt2 = dot(b, t2);
    // F = medians now times the inverse of the stress-free ones, in the plane of t1 and t2
    const Lanes even = length * kind.p1 + bt2 * kind.q2;    // F11 + F22
    const Lanes odd = -(length * kind.p2 + bt1 * kind.q2);  // F21 - F12
    trace = sqrt(even * even + odd * odd);
    const Lanes c = even / trace;
    const Lanes s = odd / trace;
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

/// Deformation in the element's axes, which is small, and the values that transform its gradient
/// back.
struct Deformation {
  Lanes u[24];           // u then theta, node by node [m], [rad]
  Triple arm[4];         // e^T (x_a - c) [m]
  Triple half_theta[4];  // sin(angle/2) axis
  Lanes cosine[4];       // cos(angle/2)
  Lanes minimum_four_cos2 = 4.0;

  FURROW_INLINE Deformation(const Quadrilateral& quad, const Frame& frame, const Shell4Kind& kind,
                            const Shell4Places& places, std::size_t first, const double* turn) {
    const Turn axes = {Lanes::load(places.axes[0] + first), Lanes::load(places.axes[1] + first),
                       Lanes::load(places.axes[2] + first), Lanes::load(places.axes[3] + first)};
    Turn back;  // from space to the element's axes
    for (int n = 0; n < 4; ++n) {
      const int* index = places.node[n] + first;
      Lanes q[4];
      to_lanes([&](int lane) { return load_record(turn + 4 * index[lane]); }, q);
      const Turn turned = Turn{q[0], q[1], q[2], q[3]} * axes;
      if (n == 0) back = conjugate(turn_of({frame.e1, frame.e2, frame.e3}, turned));
      set_displacement(n, frame.local(quad.node[n] - quad.centre), kind);
      set_rotation(n, back * turned);
    }
  }

 private:
  FURROW_INLINE void set_displacement(int n, const Triple& local, const Shell4Kind& kind) {
    arm[n] = local;
    u[6 * n] = local.x - kind.x[n][0];
    u[6 * n + 1] = local.y - kind.x[n][1];
    u[6 * n + 2] = local.z - kind.x[n][2];
  }

  FURROW_INLINE void set_rotation(int n, const Turn& relative) {
    const Lanes sign = select(relative.w < Lanes(0.0), Lanes(-1.0), Lanes(1.0));
    cosine[n] = sign * relative.w;
    minimum_four_cos2 = min(minimum_four_cos2, Lanes(4.0) * relative.w * relative.w);
    half_theta[n] = {sign * relative.x, sign * relative.y, sign * relative.z};
    u[6 * n + 3] = half_theta[n].x + half_theta[n].x;
    u[6 * n + 4] = half_theta[n].y + half_theta[n].y;
    u[6 * n + 5] = half_theta[n].z + half_theta[n].z;
  }
};

/// g = M u. Four sums at once: their additions need not wait for each other.
template <int size>
FURROW_INLINE void multiply(const double (&matrix)[size][size], const Lanes (&u)[size],
                            Lanes (&g)[size]) {
  for (int row = 0; row < size; row += 4) {
    Lanes sum0 = 0.0, sum1 = 0.0, sum2 = 0.0, sum3 = 0.0;
    for (int c = 0; c < size; ++c) {
      sum0 += matrix[row][c] * u[c];
      sum1 += matrix[row + 1][c] * u[c];
      sum2 += matrix[row + 2][c] * u[c];
      sum3 += matrix[row + 3][c] * u[c];
    }
    g[row] = sum0;
    g[row + 1] = sum1;
    g[row + 2] = sum2;
    g[row + 3] = sum3;
  }
}

/// g = K u. A mirror-symmetric element uses sums and differences of mirrored nodes, which halves
/// the number of products.
FURROW_INLINE void multiply_stiffness(const Shell4Kind& kind, const Lanes (&u)[24],
                                      Lanes (&g)[24]) {
  if (!kind.mirrored) {
    multiply(kind.stiffness, u, g);
    return;
  }
  Lanes even[12], odd[12], even_g[12], odd_g[12];
  for (int pair = 0; pair < 2; ++pair)
    for (int k = 0; k < 6; ++k) {
      const Lanes& own = u[6 * Shell4Mirror::first[pair] + k];
      const Lanes image = Shell4Mirror::sign[k] * u[6 * Shell4Mirror::second[pair] + k];
      even[6 * pair + k] = own + image;
      odd[6 * pair + k] = own - image;
    }
  multiply(kind.mirror_even, even, even_g);
  multiply(kind.mirror_odd, odd, odd_g);
  for (int pair = 0; pair < 2; ++pair)
    for (int k = 0; k < 6; ++k) {
      const int i = 6 * pair + k;
      g[6 * Shell4Mirror::first[pair] + k] = even_g[i] + odd_g[i];
      g[6 * Shell4Mirror::second[pair] + k] = Shell4Mirror::sign[k] * (even_g[i] - odd_g[i]);
    }
}

FURROW_INLINE Lanes half_product(const Lanes (&u)[24], const Lanes (&g)[24]) {
  Lanes twice = 0.0;
  for (int row = 0; row < 24; ++row) twice += u[row] * g[row];
  return Lanes(0.5) * twice;
}

/// Gradient of U, in the element's axes, by the positions of the nodes and by their spins.
struct Gradient {
  Triple nodal[4];  // of U by u alone [N]
  Triple spin[4];   // by the spins [N m]
  Triple mean;      // of nodal
  Triple on_a;      // by the medians, which the axes follow [N]
  Triple on_b;

  /// @param g = K u
  FURROW_INLINE Gradient(const Lanes (&g)[24], const Deformation& deformation, const Frame& frame,
                         const Shell4Kind& kind) {
    mean = {0.0, 0.0, 0.0};
    Triple carried = {0.0, 0.0, 0.0};  // the moment that the rotation of the axes has to carry
    for (int n = 0; n < 4; ++n) {
      nodal[n] = {g[6 * n], g[6 * n + 1], g[6 * n + 2]};
      const Triple m = {g[6 * n + 3], g[6 * n + 4], g[6 * n + 5]};
      spin[n] = deformation.cosine[n] * m + cross(deformation.half_theta[n], m);
      carried = carried + cross(deformation.arm[n], nodal[n]) + spin[n];
      mean = mean + Lanes(0.25) * nodal[n];
    }
    const Lanes per_area = Lanes(1.0) / frame.area;
    const Lanes about3 = carried.z / frame.trace;
    on_a = {-kind.p2 * about3, kind.p1 * about3,
            -per_area * (frame.b1 * carried.x + frame.b2 * carried.y)};
    on_b = {-kind.q2 * about3, 0.0, per_area * (frame.a1 * carried.x + frame.a2 * carried.y)};
  }
  FURROW_INLINE Triple by_position(int n) const {
    return nodal[n] - mean - (Lanes(0.5 * shell4_xi[n]) * on_a + Lanes(0.5 * shell4_eta[n]) * on_b);
  }
  FURROW_INLINE const Triple& by_spin(int n) const { return spin[n]; }
};

/// Consistent forces of a unit pressure on the bilinear surface, outwards [m^2].
struct UnitPressure {
  Triple AB, AC, CB;

  FURROW_INLINE explicit UnitPressure(const Quadrilateral& quad) {
    const Triple A = Lanes(0.5) * quad.a;
    const Triple B = Lanes(0.5) * quad.b;
    const Triple C = Lanes(0.25) * (quad.node[0] - quad.node[1] + (quad.node[2] - quad.node[3]));
    AB = cross(A, B);
    AC = Lanes(1.0 / 3.0) * cross(A, C);
    CB = Lanes(1.0 / 3.0) * cross(C, B);
  }
  FURROW_INLINE Triple on_node(int n) const { return AB + shell4_xi[n] * AC + shell4_eta[n] * CB; }
};

/// Adds to node n of the first `count` elements.
FURROW_INLINE void scatter(const Shell4Places& places, std::size_t first, int count, int n,
                           const Triple& force, const Triple& spin_gradient, double* on_node) {
  const Triple moment = Triple{0.0, 0.0, 0.0} - spin_gradient;
  Record forces[lane_count], moments[lane_count];
  to_records({force.x, force.y, force.z, 0.0}, forces);
  to_records({moment.x, moment.y, moment.z, 0.0}, moments);
  const int* index = places.node[n] + first;
  for (int lane = 0; lane < lane_count; ++lane) {
    if (lane >= count) break;
    add_record(forces[lane], on_node + 8 * index[lane]);
    add_record(moments[lane], on_node + 8 * index[lane] + 4);
  }
}

/// Records the element with the largest rotation of a node, or with one that is not a number.
FURROW_INLINE void note_most_rotated(const Lanes& four_cos2, std::size_t first,
                                     Shell4Result& result) {
  if (!any(!(four_cos2 >= Lanes(result.minimum_four_cos2)))) return;
  for (int lane = 0; lane < lane_count; ++lane)
    if (!(four_cos2[lane] >= result.minimum_four_cos2)) {
      result.minimum_four_cos2 = four_cos2[lane];
      result.most_rotated = first + static_cast<std::size_t>(lane);
    }
}

/// Shell4Kernel of shell4_block.h.
inline Shell4Result shell4_forces(const Shell4Kind* kinds, std::size_t kind_count,
                                  const Shell4Places& places, const double* x, const double* turn,
                                  double pressure, double* on_node) {
  Shell4Result result;
  Lanes energy = 0.0;
  Lanes volume = 0.0;
  const Lanes place([](auto lane) { return static_cast<double>(lane); });
  for (std::size_t k = 0; k < kind_count; ++k) {
    const Shell4Kind& kind = kinds[k];
    for (std::size_t i = kind.first; i < kind.last; i += lane_count) {
      const int count = kind.last - i < lane_count ? static_cast<int>(kind.last - i) : lane_count;
      const Lanes weight = select(place < Lanes(count), Lanes(1.0), Lanes(0.0));
      const Quadrilateral quad(places, i, x);
      const Frame frame(quad.a, quad.b, kind);
      const Deformation deformation(quad, frame, kind, places, i, turn);
      Lanes g[24];
      multiply_stiffness(kind, deformation.u, g);
      energy += weight * half_product(deformation.u, g);
      const Gradient gradient(g, deformation, frame, kind);
      const UnitPressure unit(quad);
      for (int n = 0; n < 4; ++n) {
        const Triple push = unit.on_node(n);
        volume += weight * (dot(push, quad.node[n]) * Lanes(1.0 / 3.0));
        const Triple force = pressure * push - frame.space(gradient.by_position(n));
        scatter(places, i, count, n, force, frame.space(gradient.by_spin(n)), on_node);
      }
      note_most_rotated(deformation.minimum_four_cos2, i, result);
    }
  }
  for (int lane = 0; lane < lane_count; ++lane) {
    result.energy += energy[lane];
    result.volume += volume[lane];
  }
  result.finite =
      result.energy - result.energy == 0.0 && result.minimum_four_cos2 == result.minimum_four_cos2;
  return result;
}

constexpr void fill(Shell4Kernels& kernels) { kernels.forces = shell4_forces; }

}  // namespace FURROW_ISA
}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A step of a tyre's nodes, several at once: damping, kick and drift in one pass. Included by
/// kernel units only (simd/lanes.h explains why).

#include "furrow/core/half_turn.h"
#include "furrow/simd/records.h"
#include "furrow/simd/turn.h"
#include "furrow/tyre/node_step_block.h"

namespace furrow {
inline namespace FURROW_ISA {

FURROW_INLINE Triple spread(const double (&v)[3]) { return {v[0], v[1], v[2]}; }
FURROW_INLINE void add(Triple& sum, const Triple& a) { sum = sum + a; }

/// Sums of forces, moments and powers over the nodes of each lane.
struct NodeSums {
  Triple force = {0.0, 0.0, 0.0}, moment = {0.0, 0.0, 0.0};
  Triple damping_force = {0.0, 0.0, 0.0}, damping_moment = {0.0, 0.0, 0.0};
  Lanes contact_power = 0.0, damping_power = 0.0;
  Lanes place = 0.0;  // finite when all places are
};

/// Neighbouring nodes in the lanes; what lies beyond the last one repeats it.
class NodeGroup {
 public:
  FURROW_INLINE NodeGroup(std::size_t first, std::size_t count)
      : first_(first),
        count_(count - first < lane_count ? static_cast<int>(count - first) : lane_count) {}

  /// 1 in lanes that have a node of their own, else 0.
  FURROW_INLINE Lanes weight() const {
    const Lanes place([](auto lane) { return static_cast<double>(lane); });
    return select(place < Lanes(count_), Lanes(1.0), Lanes(0.0));
  }
  FURROW_INLINE Triple triple(const double* numbers) const {
    Lanes n[4];
    to_lanes([&](int lane) { return load_triple(numbers + 3 * node(lane)); }, n);
    return {n[0], n[1], n[2]};
  }
  FURROW_INLINE Turn turn(const double* numbers) const {
    Lanes n[4];
    to_lanes([&](int lane) { return load_record(numbers + 4 * node(lane)); }, n);
    return {n[0], n[1], n[2], n[3]};
  }
  FURROW_INLINE void store(const Triple& t, double* numbers) const {
    Record records[lane_count];
    to_records({t.x, t.y, t.z, 0.0}, records);
    for (int lane = 0; lane < lane_count; ++lane) {
      if (lane >= count_) break;
      store_triple(records[lane], numbers + 3 * node(lane));
    }
  }
  FURROW_INLINE void store(const Turn& q, double* numbers) const {
    Record records[lane_count];
    to_records({q.x, q.y, q.z, q.w}, records);
    for (int lane = 0; lane < lane_count; ++lane) {
      if (lane >= count_) break;
      store_record(records[lane], numbers + 4 * node(lane));
    }
  }

 private:
  FURROW_INLINE std::size_t node(int lane) const {
    return first_ + static_cast<std::size_t>(lane < count_ ? lane : count_ - 1);
  }
  std::size_t first_;
  int count_;
};

/// The turn by w dt, by series while it is small.
FURROW_INLINE Turn turn_by(const Triple& w, double dt) {
  const Triple half = Lanes(0.5 * dt) * w;
  const Lanes squared = dot(half, half);
  auto [cosine, sinc] = half_turn(squared);
  const Mask large = squared > Lanes(small_half_turn);
  if (any(large)) {
    const Lanes angle = sqrt(select(large, squared, Lanes(1.0)));
    cosine = select(large, per_lane(angle, [](double a) { return __builtin_cos(a); }), cosine);
    sinc = select(large, per_lane(angle, [](double a) { return __builtin_sin(a); }) / angle, sinc);
  }
  return {sinc * half.x, sinc * half.y, sinc * half.z, cosine};
}

FURROW_INLINE void step_group(const NodeStepNodes& nodes, std::size_t first, const NodeGroup& group,
                              const NodeStepRim& rim, double rate, double dt, NodeSums& sums) {
  const Lanes weight = group.weight();
  const Triple x = group.triple(nodes.x), v = group.triple(nodes.v), w = group.triple(nodes.w);
  const Triple force = weight * group.triple(nodes.force),
               moment = weight * group.triple(nodes.moment),
               contact = weight * group.triple(nodes.contact);
  const Triple arm = x - spread(rim.centre), spin = spread(rim.spin);
  const Triple damping_force =
      -(rate * Lanes::load(nodes.mass + first)) * (v - spread(rim.velocity) - cross(spin, arm));
  const Triple damping_moment = -(rate * Lanes::load(nodes.inertia + first)) * (w - spin);
  add(sums.force, force);
  add(sums.moment, moment + cross(arm, force));
  add(sums.damping_force, damping_force);
  add(sums.damping_moment, damping_moment + cross(arm, damping_force));

  const Triple kick = Lanes(dt) * (force + contact + damping_force),
               spin_kick = Lanes(dt) * (moment + damping_moment);
  const auto moved = [&](const Triple& from, const double* const(&mobility)[3], const Triple& by) {
    return Triple{from.x + Lanes::load(mobility[0] + first) * by.x,
                  from.y + Lanes::load(mobility[1] + first) * by.y,
                  from.z + Lanes::load(mobility[2] + first) * by.z};
  };
  const Triple v_next = moved(v, nodes.mobility, kick),
               w_next = moved(w, nodes.spin_mobility, spin_kick);
  const Triple v_mean = Lanes(0.5) * (v + v_next), w_mean = Lanes(0.5) * (w + w_next);
  sums.contact_power += dot(contact, v_mean);
  sums.damping_power += dot(damping_force, v_mean) + dot(damping_moment, w_mean);

  const Triple x_next = x + Lanes(dt) * v_next;
  sums.place += x_next.x + x_next.y + x_next.z;
  group.store(v_next, nodes.v);
  group.store(w_next, nodes.w);
  group.store(x_next, nodes.x);
  group.store(normalised(turn_by(w_next, dt) * group.turn(nodes.turn)), nodes.turn);
}

inline NodeStepSums node_step(const NodeStepNodes& nodes, const NodeStepRim& rim, double rate,
                              double dt) {
  NodeSums sums;
  std::size_t first = 0;
  for (; first + lane_count <= nodes.count; first += lane_count)
    step_group(nodes, first, NodeGroup(first, first + lane_count), rim, rate, dt, sums);
  if (first < nodes.count)
    step_group(nodes, first, NodeGroup(first, nodes.count), rim, rate, dt, sums);

  NodeStepSums result;
  const auto reduce = [](const Triple& t, double(&out)[3]) {
    out[0] = sum(t.x);
    out[1] = sum(t.y);
    out[2] = sum(t.z);
  };
  reduce(sums.force, result.force);
  reduce(sums.moment, result.moment);
  reduce(sums.damping_force, result.damping_force);
  reduce(sums.damping_moment, result.damping_moment);
  result.contact_power = sum(sums.contact_power);
  result.damping_power = sum(sums.damping_power);
  const double place = sum(sums.place);
  result.finite = place - place == 0.0;
  return result;
}

constexpr void fill(NodeStepKernels& kernels) { kernels.step = node_step; }

}  // namespace FURROW_ISA
}  // namespace furrow

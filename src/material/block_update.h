#pragma once
/// The loop over a block: loads a few points, lets a law's kernel update them, turns the stress, stores, counts.

#include <cstddef>
#include <cstdint>

#include "material/kernel_table.h"
#include "material/kinematics.h"

namespace furrow {
inline namespace FURROW_ISA {

/// What a kernel sees of lane_count points: the common state at the start of the step, to be replaced by that at its end.
struct Points {
  Symmetric stress;              ///< in the frame of the start of the step [Pa]
  Lanes stored = 0.0;            ///< energies of this step per current volume [J/m^3]
  Lanes frozen = 0.0;
  Lanes dissipated = 0.0;
  Lanes own[6];                  ///< the law's own fields
  Lanes branch = 0.0;            ///< a Branch
  Lanes iterations = 0.0;
  Mask below_data = Mask(false);   ///< outside the hardening data
  Mask beyond_data = Mask(false);
  Mask stopped = Mask(false);      ///< the same, and the rule is to stop
};

struct Step {
  Lanes volume;     ///< det Delta F
  Mask admissible;  ///< Delta F finite with positive determinant
  bool total_energy = false;  ///< points.stored is the energy per reference volume, not the work of the step
};

/// Laws of rate form: the strain is the logarithm of the step's stretch, the stress is turned afterwards.
template <class Kernel>
auto step_points(const Kernel& kernel, const Tensor& h, Points& points) -> decltype(kernel.step(Symmetric{}, points), Step{}) {
  const Motion motion = motion_of(h);
  kernel.step(motion.strain, points);
  points.stress = turned(points.stress, motion.rotation);
  return {motion.volume, motion.admissible, false};
}
/// Hyperelastic laws: they carry their deformation with them.
template <class Kernel>
auto step_points(const Kernel& kernel, const Tensor& h, Points& points) -> decltype(kernel.hyperelastic_step(h, points), Step{}) {
  kernel.hyperelastic_step(h, points);
  const Lanes volume = volume_change(h);
  return {volume, volume > Lanes(0.0), true};
}

/// Kernel: `static constexpr int own_fields;` and either `void step(const Symmetric& strain, Points&) const`
/// or `void hyperelastic_step(const Tensor& h, Points&) const`.
template <class Kernel>
BlockResult update_points(const Kernel& kernel, double density, const PointBlock& block) {
  static_assert(Kernel::own_fields <= 6, "enlarge Points::own");
  BlockResult result;
  const double dense = density / ice_density;  // J below this is denser than ice
  for (std::size_t first = 0; first < block.size; first += lane_count) {
    const std::size_t left = block.size - first;
    const int lanes = left < static_cast<std::size_t>(lane_count) ? static_cast<int>(left) : lane_count;
    const bool full = lanes == lane_count;
    // The missing points of the last group are copies of its first.
    const auto load = [&](const double* array) {
      if (full) return Lanes(array + first, stdx::element_aligned);
      return Lanes([&](auto lane) { return array[first + static_cast<std::size_t>(int(lane) < lanes ? int(lane) : 0)]; });
    };
    const auto store = [&](double* array, const Lanes& value) {
      if (full) {
        value.copy_to(array + first, stdx::element_aligned);
      } else {
        for (int lane = 0; lane < lanes; ++lane) array[first + static_cast<std::size_t>(lane)] = value[lane];
      }
    };
    const auto count = [&](const Mask& mask) {
      if (full) return static_cast<std::size_t>(stdx::popcount(mask));
      std::size_t sum = 0;
      for (int lane = 0; lane < lanes; ++lane) sum += mask[lane] ? 1 : 0;
      return sum;
    };

    Tensor h;
    for (std::size_t k = 0; k < 9; ++k) h.m[k] = load(block.gradient[k]);
    Points points;
    double* const* state = block.state;
    points.stress = {load(state[0]), load(state[1]), load(state[2]), load(state[3]), load(state[4]), load(state[5])};
    for (int k = 0; k < Kernel::own_fields; ++k) points.own[k] = load(state[field::own + static_cast<std::size_t>(k)]);

    const Step step = step_points(kernel, h, points);

    const Symmetric& stress = points.stress;
    const Lanes ratio = load(state[field::volume_ratio]) * step.volume;
    const Mask good = step.admissible && !points.stopped && finite(contract(stress, stress) + ratio) && ratio > Lanes(0.0);
    if (!all(good)) {
      for (int lane = 0; lane < lanes; ++lane) {
        if (good[lane]) continue;
        result.failure = !step.admissible[lane] ? Failure::folded : points.stopped[lane] ? Failure::table_ends : Failure::not_finite;
        result.failed_point = first + static_cast<std::size_t>(lane);
        return result;
      }
    }
    store(state[0], stress.xx);
    store(state[1], stress.yy);
    store(state[2], stress.zz);
    store(state[3], stress.xy);
    store(state[4], stress.yz);
    store(state[5], stress.xz);
    store(state[field::volume_ratio], ratio);
    if (step.total_energy) {
      store(state[field::stored_energy], points.stored);
    } else {
      store(state[field::stored_energy], load(state[field::stored_energy]) + ratio * points.stored);
      store(state[field::frozen_energy], load(state[field::frozen_energy]) + ratio * points.frozen);
      store(state[field::dissipated_energy], load(state[field::dissipated_energy]) + ratio * points.dissipated);
    }
    for (int k = 0; k < Kernel::own_fields; ++k) store(state[field::own + static_cast<std::size_t>(k)], points.own[k]);

    UpdateReport& report = result.report;
    std::size_t yielding = 0;
    for (std::size_t b = 1; b < branch_count; ++b) {
      const std::size_t number = count(points.branch == Lanes(static_cast<double>(b)));
      report.points[b] += number;
      yielding += number;
    }
    report.points[0] += static_cast<std::size_t>(lanes) - yielding;
    if (yielding > 0) {
      for (int lane = 0; lane < lanes; ++lane) {
        const std::size_t iterations = static_cast<std::size_t>(static_cast<double>(points.iterations[lane]));
        report.iterations += iterations;
        if (iterations > report.most_iterations) report.most_iterations = iterations;
      }
    }
    report.below_data += count(points.below_data);
    report.beyond_data += count(points.beyond_data);
    report.beyond_ice += count(ratio < Lanes(dense));
    if (block.branch)
      for (int lane = 0; lane < lanes; ++lane)
        block.branch[first + static_cast<std::size_t>(lane)] = static_cast<std::uint8_t>(static_cast<double>(points.branch[lane]));
  }
  return result;
}

}  // namespace FURROW_ISA
}  // namespace furrow

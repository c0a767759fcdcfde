// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The loop over a block: it loads a few points, calls the kernel of the law, rotates the stress,
/// stores and counts.

#include <cstddef>
#include <cstdint>

#include "furrow/material/kinematics.h"
#include "furrow/material/point_block.h"

namespace furrow {
inline namespace FURROW_ISA {

/// State of lane_count points in a kernel: at the start of the step, to be replaced by that at its
/// end.
template <int internal_variables>
struct Points {
  Symmetric stress;    ///< in the frame of the start of the step [Pa]
  Lanes stored = 0.0;  ///< energies of this step per current volume [J/m^3]
  Lanes frozen = 0.0;
  Lanes dissipated = 0.0;
  Lanes internal[internal_variables > 0 ? internal_variables : 1];  ///< internal variables
  double time_step = 0.0;                                           ///< [s]
  Lanes branch = 0.0;                                               ///< a Branch
  Lanes iterations = 0.0;
  Mask below_data = Mask(false);  ///< outside the hardening data
  Mask beyond_data = Mask(false);
  Mask stopped = Mask(false);  ///< points beyond the data of a law that stops there
};

struct Step {
  Lanes volume;     ///< det Delta F
  Mask admissible;  ///< Delta F finite with positive determinant
  /// points.stored is the energy per reference volume, not the work of the step
  bool total_energy = false;
};

/// Laws of rate form: the strain is the logarithm of the step's stretch, the stress is rotated
/// afterwards.
template <class Kernel, int n>
FURROW_INLINE auto step_points(const Kernel& kernel, const Tensor& h, Points<n>& points)
    -> decltype(kernel.step(Symmetric{}, points), Step{}) {
  Motion motion;
  find_motion(h, motion);
  kernel.step(motion.strain, points);
  points.stress = rotated(points.stress, motion.rotation);
  return {motion.volume, motion.admissible, false};
}
/// Hyperelastic laws: they carry their deformation with them.
template <class Kernel, int n>
FURROW_INLINE auto step_points(const Kernel& kernel, const Tensor& h, Points<n>& points)
    -> decltype(kernel.hyperelastic_step(h, points), Step{}) {
  kernel.hyperelastic_step(h, points);
  const Lanes volume = volume_change(h);
  return {volume, volume > Lanes(0.0), true};
}

/// lane_count neighbouring points of a block; the last group may have fewer.
struct Group {
  const PointBlock& block;
  std::size_t first;
  int lanes;

  Group(const PointBlock& points, std::size_t start)
      : block(points),
        first(start),
        lanes(points.size - start < lane_count ? static_cast<int>(points.size - start)
                                               : lane_count) {}

  /// Missing points are copies of the group's first.
  FURROW_INLINE Lanes load(const double* array) const {
    if (lanes == lane_count) return Lanes::load(array + first);
    return Lanes([&](auto lane) {
      return array[first + static_cast<std::size_t>(int(lane) < lanes ? int(lane) : 0)];
    });
  }
  FURROW_INLINE void store(double* array, const Lanes& value) const {
    if (lanes < lane_count) {
      alignas(64) double numbers[lane_count];  // value[lane] would keep the value in memory always
      value.store(numbers);
      for (int lane = 0; lane < lanes; ++lane)
        array[first + static_cast<std::size_t>(lane)] = numbers[lane];
    } else {
      value.store(array + first);
    }
  }
  FURROW_INLINE std::size_t count(const Mask& mask) const {
    if (lanes == lane_count) return static_cast<std::size_t>(furrow::count(mask));
    std::size_t sum = 0;
    for (int lane = 0; lane < lanes; ++lane) sum += mask[lane] ? 1 : 0;
    return sum;
  }

  FURROW_INLINE Tensor load_gradient() const {
    Tensor h;
#pragma GCC unroll 9
    for (std::size_t k = 0; k < 9; ++k) h.m[k] = load(block.gradient[k]);
    return h;
  }
  /// @param used  of the n internal variables
  template <int n>
  FURROW_INLINE Points<n> load_points(int used = n) const {
    Points<n> points;
    points.time_step = block.time_step;
    double* const* state = block.state;
    points.stress = {load(state[0]), load(state[1]), load(state[2]),
                     load(state[3]), load(state[4]), load(state[5])};
    for (int k = 0; k < used; ++k)
      points.internal[k] = load(state[field::internal + static_cast<std::size_t>(k)]);
    return points;
  }

  /// Checks and stores the end of the step. False, with the cause in the result, when the states
  /// must not be continued.
  template <int n>
  FURROW_INLINE bool store_points(const Points<n>& points, const Step& step, double density,
                                  BlockResult& result, int used = n) const {
    double* const* state = block.state;
    const Symmetric& stress = points.stress;
    const Lanes ratio = load(state[field::volume_ratio]) * step.volume;
    Lanes everything =
        contract(stress, stress) + ratio + points.stored + points.frozen + points.dissipated;
    for (int k = 0; k < used; ++k) everything += points.internal[k];
    const Mask good =
        step.admissible && !points.stopped && finite(everything) && ratio > Lanes(0.0);
    if (!all(good)) {
      for (int lane = 0; lane < lanes; ++lane) {
        if (good[lane]) continue;
        result.failure = !step.admissible[lane] ? Failure::folded
                         : points.stopped[lane] ? Failure::table_ends
                                                : Failure::not_finite;
        result.failed_point = first + static_cast<std::size_t>(lane);
        return false;
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
      store(state[field::dissipated_energy],
            load(state[field::dissipated_energy]) + ratio * points.dissipated);
    }
    for (int k = 0; k < used; ++k)
      store(state[field::internal + static_cast<std::size_t>(k)], points.internal[k]);

    UpdateReport& report = result.report;
    report.points[0] += static_cast<std::size_t>(lanes);
    if (any(points.branch > Lanes(0.0))) {
      for (std::size_t b = 1; b < branch_count; ++b) {
        const std::size_t number = count(points.branch == Lanes(static_cast<double>(b)));
        report.points[b] += number;
        report.points[0] -= number;
      }
      alignas(64) double evaluations[lane_count];
      points.iterations.store(evaluations);
      for (int lane = 0; lane < lanes; ++lane) {
        const std::size_t iterations = static_cast<std::size_t>(evaluations[lane]);
        report.iterations += iterations;
        if (iterations > report.max_iterations) report.max_iterations = iterations;
      }
    }
    report.below_data += count(points.below_data);
    report.beyond_data += count(points.beyond_data);
    report.beyond_ice += count(ratio < Lanes(density / ice_density));
    if (block.branch) {
      alignas(64) double branches[lane_count];
      points.branch.store(branches);
      for (int lane = 0; lane < lanes; ++lane)
        block.branch[first + static_cast<std::size_t>(lane)] =
            static_cast<std::uint8_t>(branches[lane]);
    }
    return true;
  }
};

/// Group by group. Kernel: `static constexpr int internal_variables;` and either `void step(const
/// Symmetric& strain, Points<internal_variables>&) const` or `void hyperelastic_step(const Tensor&
/// h, Points<internal_variables>&) const`.
template <class Kernel>
BlockResult update_points(const Kernel& kernel, double density, const PointBlock& block) {
  BlockResult result;
  for (std::size_t first = 0; first < block.size; first += lane_count) {
    const Group group(block, first);
    Points<Kernel::internal_variables> points = group.load_points<Kernel::internal_variables>();
    const Step step = step_points(kernel, group.load_gradient(), points);
    if (!group.store_points(points, step, density, result)) break;
  }
  return result;
}

/// Updates the points of a block by a kernel with an expensive return mapping. The first pass
/// computes trial states and finishes groups whose points are all elastic or all on one surface.
/// The second pass gathers the points of a few mixed groups by surface and corrects them, so that
/// no lane waits for a neighbour on another surface. The third pass finishes these groups. Between
/// the passes a point is a few numbers. A kernel has
///   Prediction    the numbers of the trial, and the surface that each point still violates, if any
///   Numbers       the numbers of the end of the step
/// and, with `trial` and `end` for the numbers of these,
///   Prediction predict(strain, points, Numbers& end)
///   Numbers    correct(surface, trial)
///   void       finish(strain, trial, end, points)
template <class Kernel>
class GatheredUpdate {
 public:
  GatheredUpdate(const Kernel& kernel, double density, const PointBlock& block)
      : kernel_(kernel), density_(density), block_(block) {}

  BlockResult run() {
    for (std::size_t first = 0; first < block_.size; first += lane_count) {
      const Group group(block_, first);
      if (!predict(group) || (mixed_ == max_mixed && !finish_mixed())) return result_;
    }
    finish_mixed();
    return result_;
  }

 private:
  static constexpr int max_mixed = 8, size = max_mixed * lane_count;
  static constexpr int inputs = Kernel::prediction_numbers, outputs = Kernel::return_numbers,
                       surfaces = Kernel::surface_count;
  using StepPoints = Points<Kernel::internal_variables>;

  /// The trial of a group, and all of its step unless it is mixed. False: see Group::store_points.
  FURROW_INLINE bool predict(const Group& group) {
    Motion motion;
    find_motion(group.load_gradient(), motion);
    StepPoints points = group.load_points<Kernel::internal_variables>();
    typename Kernel::Numbers end;
    const typename Kernel::Prediction prediction = kernel_.predict(motion.strain, points, end);
    Mask violated = prediction.violated[0];
    for (int surface = 1; surface < surfaces; ++surface)
      violated = violated || prediction.violated[surface];
    if (!any(violated)) return finish(group, motion, prediction.numbers, end.numbers, points);

    const int g = mixed_++;
    first_[g] = group.first;
    motions_[g] = motion;
    for (int k = 0; k < inputs; ++k) prediction.numbers[k].store(&in_[k][g * lane_count]);
    for (int k = 0; k < outputs; ++k) end.numbers[k].store(&out_[k][g * lane_count]);
    alignas(64) double flags[lane_count];
    for (int surface = 0; surface < surfaces; ++surface) {
      if (!any(prediction.violated[surface])) continue;
      select(prediction.violated[surface], 1.0, 0.0).store(flags);
      for (int lane = 0; lane < group.lanes; ++lane) {
        members_[surface][count_[surface]] = g * lane_count + lane;
        count_[surface] += flags[lane] > 0.0 ? 1 : 0;
      }
    }
    return true;
  }

  bool finish_mixed() {
    for (int surface = 0; surface < surfaces; ++surface) correct(surface);
    for (int g = 0; g < mixed_; ++g) {
      const Group group(block_, first_[g]);
      StepPoints points = group.load_points<Kernel::internal_variables>();
      Lanes numbers[inputs], ends[outputs];
      for (int k = 0; k < inputs; ++k) numbers[k] = Lanes::load(&in_[k][g * lane_count]);
      for (int k = 0; k < outputs; ++k) ends[k] = Lanes::load(&out_[k][g * lane_count]);
      if (!finish(group, motions_[g], numbers, ends, points)) return false;
    }
    mixed_ = 0;
    return true;
  }

  /// The points of the mixed groups that violate a surface.
  FURROW_INLINE void correct(int surface) {
    alignas(64) double lane_numbers[lane_count];
    for (int done = 0; done < count_[surface]; done += lane_count) {
      const int* const list = members_[surface] + done;
      const int lanes = count_[surface] - done < lane_count ? count_[surface] - done : lane_count;
      Lanes numbers[inputs];
      for (int k = 0; k < inputs; ++k)
        numbers[k] =
            Lanes([&](auto lane) { return in_[k][list[int(lane) < lanes ? int(lane) : 0]]; });
      const typename Kernel::Numbers end = kernel_.correct(surface, numbers);
      for (int k = 0; k < outputs; ++k) {
        end.numbers[k].store(lane_numbers);
        for (int lane = 0; lane < lanes; ++lane) out_[k][list[lane]] = lane_numbers[lane];
      }
    }
    count_[surface] = 0;
  }

  FURROW_INLINE bool finish(const Group& group, const Motion& motion, const Lanes* trial,
                            const Lanes* end, StepPoints& points) {
    kernel_.finish(motion.strain, trial, end, points);
    points.stress = rotated(points.stress, motion.rotation);
    return group.store_points(points, {motion.volume, motion.admissible, false}, density_, result_);
  }

  const Kernel& kernel_;
  double density_;
  const PointBlock& block_;
  BlockResult result_;
  // The groups that wait for their correction.
  int mixed_ = 0;
  std::size_t first_[max_mixed];
  Motion motions_[max_mixed];
  alignas(64) double in_[inputs][size];
  alignas(64) double out_[outputs][size];
  int members_[surfaces][size];  // points that violate a surface
  int count_[surfaces] = {};
};

template <class Kernel>
BlockResult update_gathered(const Kernel& kernel, double density, const PointBlock& block) {
  return GatheredUpdate<Kernel>(kernel, density, block).run();
}

}  // namespace FURROW_ISA
}  // namespace furrow

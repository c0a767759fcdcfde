// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/transfer/remap_control.h"

#include <algorithm>
#include <cmath>

namespace furrow {

namespace {

// travel in an interval, of the shortest cell times the volume ratio
constexpr double max_travel = 0.05;
// shortest cells that a wave crosses while the residual motion of slow ground falls to its share
constexpr double cells_of_share = 6.4;

}  // namespace

RemapControl::RemapControl(const Discretisation& discretisation, int max_steps,
                           double residual_share, double wave_speed)
    : discretisation_(discretisation),
      max_steps_(max_steps),
      decay_(residual_share > 0.0 ? std::log(residual_share) : 0.0),
      time_of_share_(cells_of_share * discretisation.grid.shortest_cell() / wave_speed) {}

void RemapControl::begin_interval(double dt) {
  double max_square = 0.0;
  double max_square_over_ratio = 0.0;  // (v/J)^2
  for (const ParticleGroup& group : discretisation_.groups) {
    const double* v = group.particles.data(column::velocity);
    const double* ratio = group.particles.data(column::state + field::volume_ratio);
    group.for_awake([&](std::size_t from, std::size_t to) {
      for (std::size_t p = from; p < to; ++p) {
        const double square =
            v[4 * p] * v[4 * p] + v[4 * p + 1] * v[4 * p + 1] + v[4 * p + 2] * v[4 * p + 2];
        max_square = std::max(max_square, square);
        max_square_over_ratio = std::max(max_square_over_ratio, square / (ratio[p] * ratio[p]));
      }
    });
  }
  largest_speed_ = std::sqrt(max_square);
  travel_ = elapsed_ = 0.0;
  const double speed = discretisation_.ranks().max(std::sqrt(max_square_over_ratio));
  const double most = max_steps_;
  const double steps =
      speed > 0.0 ? max_travel * discretisation_.grid.shortest_cell() / (speed * dt) : most;
  steps_left_ = std::max(1, static_cast<int>(std::min(steps, most)));
}

double RemapControl::count_step(double dt) {
  const double step_travel = discretisation_.ranks().max(largest_speed_) * dt;
  travel_ += step_travel;
  elapsed_ += dt;
  if (--steps_left_ > 0 && travel_ > 2.0 * max_travel * discretisation_.grid.shortest_cell())
    steps_left_ = 0;
  return step_travel;
}

double RemapControl::residual_share() const {
  const double travel = travel_ / (max_travel * discretisation_.grid.shortest_cell());
  return std::exp(decay_ * std::max(elapsed_ / time_of_share_, travel));
}

void RemapControl::raise_largest_speed(double speed) {
  largest_speed_ = std::max(largest_speed_, speed);
}

void RemapControl::checkpoint(Checkpoint& state) {
  state.value("travel", travel_);
  state.value("interval_time", elapsed_);
  largest_speed_ = discretisation_.ranks().max(largest_speed_);
  state.value("largest_speed", largest_speed_);
  state.value("steps_to_remap", steps_left_);
  state.value("particles_lag", particles_lag_);
}

}  // namespace furrow

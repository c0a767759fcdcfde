// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/transfer/cell_average.h"

namespace furrow {

namespace {

/// Calls add(p, c), for every particle p of each cell, with what takes its value to the cell's
/// mean: mean - value(p).
template <class Value, class Add>
void for_deviations(const ParticleView& particles, Value&& value, Add&& add) {
  for (std::size_t first = 0, end; first < particles.size; first = end) {
    double volume = 0.0, sum = 0.0;
    for (end = first; end < particles.size && particles.cell[end] == particles.cell[first]; ++end) {
      const double v = particles.volume[end] * particles.volume_ratio[end];
      volume += v;
      sum += v * value(end);
    }
    const double mean = sum / volume;
    for (std::size_t p = first; p < end; ++p) add(p, mean - value(p));
  }
}

}  // namespace

void average_volume_change(const ParticleView& particles, double* const* gradient) {
  double* diagonal[3] = {gradient[0], gradient[4], gradient[8]};
  for_deviations(
      particles,
      [&](std::size_t p) { return (diagonal[0][p] + diagonal[1][p] + diagonal[2][p]) / 3.0; },
      [&](std::size_t p, double change) {
        for (double* h : diagonal) h[p] += change;
      });
}

void average_pressure(ParticleView& particles, double* const* normal_stress) {
  const double* const stress[3] = {particles.stress[0], particles.stress[1], particles.stress[2]};
  for_deviations(
      particles, [&](std::size_t p) { return (stress[0][p] + stress[1][p] + stress[2][p]) / 3.0; },
      [&](std::size_t p, double change) {
        for (int a = 0; a < 3; ++a) normal_stress[a][p] = stress[a][p] + change;
      });
  for (int a = 0; a < 3; ++a) particles.stress[a] = normal_stress[a];
}

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/sidewall/sidewall_direct.h"

#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

SidewallDirect::SidewallDirect(const SidewallParameters& parameters, double pressure)
    : chain_(parameters) {
  set_pressure(pressure);
}

void SidewallDirect::set_pressure(double pressure) {
  if (!(pressure >= 0.0) || !std::isfinite(pressure))
    throw StateError(fmt::format("sidewall: the pressure is {} Pa; it must be >= 0", pressure));
  pressure_ = pressure;
}

void SidewallDirect::evaluate(const SidewallEnd* ends, SidewallResponse* responses, std::size_t n,
                              bool with_stiffness) {
  if (angles_.size() < n) angles_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    try {
      responses[i] = chain_.solve(ends[i], pressure_, angles_[i], with_stiffness);
    } catch (const StateError& error) {
      throw StateError(fmt::format("station {}: {}", i, error.what()));
    }
  }
}

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/results/run_report.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace furrow {

void Audit::set_energies(std::vector<EnergyTerm> terms, double residual) {
  energies = std::move(terms);
  energy_residual = residual;
  energy_scale = 0.0;
  for (const EnergyTerm& term : energies)
    energy_scale = std::max(energy_scale, std::abs(term.value));
}

double peak_memory() {
  rusage usage{};
  // Linux counts in KiB
  return getrusage(RUSAGE_SELF, &usage) == 0 ? 1024.0 * double(usage.ru_maxrss) : 0.0;
}

}  // namespace furrow

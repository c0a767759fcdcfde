// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Saves totals since the start, of which every rank has a part, in a checkpoint.

#include <cstddef>

#include "furrow/core/checkpoint.h"
#include "furrow/core/communicator.h"

namespace furrow::coupling {

/// Saves the sums over all ranks. After restoring, the first rank continues with them and the
/// others begin at zero. Collective.
template <std::size_t count>
void checkpoint_totals(Checkpoint& state, const Communicator& ranks, double (&totals)[count]) {
  if (state.saving()) ranks.sum(totals, count);
  state.values("totals", totals, count);
  if (state.saving() || ranks.rank() == 0) return;
  for (double& total : totals) total = 0.0;
}

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Sums of a fix ave/time, which are private members.

#include "furrow/core/checkpoint.h"
#include "fix_ave_time.h"

namespace furrow::coupling {

/// Saves or brings back the sums and next_step().
void checkpoint_averages(Checkpoint& state, LAMMPS_NS::FixAveTime& fix);

/// The step that adds to the sums next.
LAMMPS_NS::bigint next_step(const LAMMPS_NS::FixAveTime& fix);
/// True if its file has a block of rows for each step (mode vector), not one row.
bool writes_blocks(const LAMMPS_NS::FixAveTime& fix);

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Judges whether a wheel that is free along x makes progress; without progress nothing is
/// averaged.

#include <string>

#include "furrow/statistics/history.h"

namespace furrow {

/// Motion of the axle in the second half of the cruise, at the speed v with the rim speed u. Growth
/// counts where it is significant at 99 %.
///   prescribed     The rig prescribes the speed.
///   travels        The wheel makes progress: none of the following is true.
///   runs_away      |v| or |u| grows by more than a tenth. The growth goes on: its last quarter has
///                  at least half of that of the third.
///   digs_in        |v| is below half of |u|, and the hub drop grows by more than a twentieth.
///   stalled        |v| is below a twentieth of |u|. Or both are below a thousandth of the largest
///                  speed of the run.
///   rolls_back     The axle moves against its rim, or against x while the rim rests.
enum class Travel { prescribed, travels, runs_away, digs_in, stalled, rolls_back };

struct TravelVerdict {
  Travel travel = Travel::travels;
  std::string sentence;  ///< reason, with its numbers; empty if prescribed or travelling
};

/// @param first_of_cruise row
TravelVerdict judge_travel(const History& history, std::size_t first_of_cruise);

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Judges whether a wheel that is free along x makes progress; without progress nothing is
/// averaged.

#include <string>

#include "furrow/statistics/history.h"

namespace furrow {

/// Motion of the axle in the second half of the cruise, v its speed, u that of the rim:
///   prescribed     the rig gives it its speed
///   travels        none of the following
///   runs_away      |v| or |u| grows significantly (99 %), by more than a tenth, and does not level
///                  off: in the last quarter of the cruise at least half as much as in the third
///   digs_in        |v| is below half of |u|, and the hub drop grows significantly, by more than a
///                  twentieth
///   stalled        |v| is below a twentieth of |u|, or both are below 1e-3 of the largest speed of
///                  the run
///   rolls_back     the axle moves against its rim, or against x while the rim rests
enum class Travel { prescribed, travels, runs_away, digs_in, stalled, rolls_back };

struct TravelVerdict {
  Travel travel = Travel::travels;
  std::string sentence;  ///< reason, with its numbers; empty if prescribed or travelling
};

/// @param first_of_cruise row
TravelVerdict judge_travel(const History& history, std::size_t first_of_cruise);

}  // namespace furrow

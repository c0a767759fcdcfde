// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/data/averages.h"

#include <cstddef>
#include <cstdint>

#include "coupling/liggghts/data/expose.h"

namespace furrow::coupling {

namespace exposed {

FURROW_EXPOSE(AveTimeMode, LAMMPS_NS::FixAveTime, int, mode);
FURROW_EXPOSE(AveTimeKind, LAMMPS_NS::FixAveTime, int, ave);
FURROW_EXPOSE(AveTimeValues, LAMMPS_NS::FixAveTime, int, nvalues);
FURROW_EXPOSE(AveTimeRows, LAMMPS_NS::FixAveTime, int, nrows);
FURROW_EXPOSE(AveTimeWindow, LAMMPS_NS::FixAveTime, int, nwindow);
FURROW_EXPOSE(AveTimeRepeat, LAMMPS_NS::FixAveTime, int, irepeat);
FURROW_EXPOSE(AveTimeNext, LAMMPS_NS::FixAveTime, LAMMPS_NS::bigint, nvalid);
FURROW_EXPOSE(AveTimeNorm, LAMMPS_NS::FixAveTime, int, norm);
FURROW_EXPOSE(AveTimeInWindow, LAMMPS_NS::FixAveTime, int, iwindow);
FURROW_EXPOSE(AveTimeWindowFull, LAMMPS_NS::FixAveTime, int, window_limit);
FURROW_EXPOSE(AveTimeSum, LAMMPS_NS::FixAveTime, double*, vector);
FURROW_EXPOSE(AveTimeTotal, LAMMPS_NS::FixAveTime, double*, vector_total);
FURROW_EXPOSE(AveTimeList, LAMMPS_NS::FixAveTime, double**, vector_list);
FURROW_EXPOSE(AveTimeSums, LAMMPS_NS::FixAveTime, double**, array);
FURROW_EXPOSE(AveTimeTotals, LAMMPS_NS::FixAveTime, double**, array_total);
FURROW_EXPOSE(AveTimeLists, LAMMPS_NS::FixAveTime, double***, array_list);

}  // namespace exposed

namespace {

using namespace exposed;

constexpr int window = 2, vector_mode = 1;  // of LIGGGHTS's enumerations

}  // namespace

LAMMPS_NS::bigint next_step(const LAMMPS_NS::FixAveTime& fix) { return fix.*member(AveTimeNext{}); }

bool writes_blocks(const LAMMPS_NS::FixAveTime& fix) {
  return fix.*member(AveTimeMode{}) == vector_mode;
}

/// LIGGGHTS's tables lie in memory row after row.
void checkpoint_averages(Checkpoint& state, LAMMPS_NS::FixAveTime& fix) {
  const bool table = writes_blocks(fix);
  auto count = static_cast<std::size_t>(fix.*member(AveTimeValues{}));
  if (table) count *= static_cast<std::size_t>(fix.*member(AveTimeRows{}));
  state.match("numbers", count);
  state.match("kind of mean", fix.*member(AveTimeKind{}));
  state.value("repeats", fix.*member(AveTimeRepeat{}));
  state.value("norm", fix.*member(AveTimeNorm{}));
  std::int64_t next = fix.*member(AveTimeNext{});
  state.value("next_step", next);
  fix.*member(AveTimeNext{}) = next;
  state.values("sums", table ? (fix.*member(AveTimeSums{}))[0] : fix.*member(AveTimeSum{}), count);
  state.values("totals", table ? (fix.*member(AveTimeTotals{}))[0] : fix.*member(AveTimeTotal{}),
               count);
  if (fix.*member(AveTimeKind{}) != window) return;
  const auto means = static_cast<std::size_t>(fix.*member(AveTimeWindow{}));
  state.match("window", means);
  state.value("place_in_window", fix.*member(AveTimeInWindow{}));
  state.value("window_is_full", fix.*member(AveTimeWindowFull{}));
  state.values("window",
               table ? (fix.*member(AveTimeLists{}))[0][0] : (fix.*member(AveTimeList{}))[0],
               means * count);
}

}  // namespace furrow::coupling

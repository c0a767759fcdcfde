// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/averages.h"

#include <cstddef>
#include <cstdint>

#include "coupling/liggghts/expose.h"

namespace furrow::coupling {

namespace exposed {

#define FURROW_EXPOSE(Tag, Type, member_name)   \
  struct Tag {                                  \
    using type = Type LAMMPS_NS::FixAveTime::*; \
    friend type member(Tag);                    \
  };                                            \
  template struct Expose<Tag, &LAMMPS_NS::FixAveTime::member_name>

FURROW_EXPOSE(AveTimeMode, int, mode);
FURROW_EXPOSE(AveTimeKind, int, ave);
FURROW_EXPOSE(AveTimeValues, int, nvalues);
FURROW_EXPOSE(AveTimeRows, int, nrows);
FURROW_EXPOSE(AveTimeWindow, int, nwindow);
FURROW_EXPOSE(AveTimeRepeat, int, irepeat);
FURROW_EXPOSE(AveTimeNext, LAMMPS_NS::bigint, nvalid);
FURROW_EXPOSE(AveTimeNorm, int, norm);
FURROW_EXPOSE(AveTimeInWindow, int, iwindow);
FURROW_EXPOSE(AveTimeWindowFull, int, window_limit);
FURROW_EXPOSE(AveTimeSum, double*, vector);
FURROW_EXPOSE(AveTimeTotal, double*, vector_total);
FURROW_EXPOSE(AveTimeList, double**, vector_list);
FURROW_EXPOSE(AveTimeSums, double**, array);
FURROW_EXPOSE(AveTimeTotals, double**, array_total);
FURROW_EXPOSE(AveTimeLists, double***, array_list);

#undef FURROW_EXPOSE

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

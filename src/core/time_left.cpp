// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/core/time_left.h"

namespace furrow {

namespace {

constexpr double share_looked_at = 1.0 / 3.0;  // share of the elapsed time that the estimate uses

}  // namespace

void TimeLeft::note(double done, double elapsed) {
  notes_.push_back({done, elapsed});
  const double start = (1.0 - share_looked_at) * elapsed;
  while (notes_.size() > 2 && notes_[1].elapsed <= start) notes_.pop_front();
}

double TimeLeft::estimate() const {
  const Note &first = notes_.front(), &second = notes_[notes_.size() > 1 ? 1 : 0],
             &last = notes_.back();
  // state of the job at the start of the last third, between the first two notes
  const double start = (1.0 - share_looked_at) * last.elapsed,
               span = second.elapsed - first.elapsed;
  const double share = span > 0.0 ? (start - first.elapsed) / span : 0.0;
  const double done = last.done - (first.done + share * (second.done - first.done));
  return done > 0.0 ? (last.elapsed - start) * (1.0 - last.done) / done : 0.0;
}

}  // namespace furrow

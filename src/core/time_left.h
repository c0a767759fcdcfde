// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How long a job will still take, from how far it was when.

#include <deque>

namespace furrow {

/// Assumes that the rest goes on as the last third of the time so far: what a step costs changes
/// when the wheel touches the ground, and the mean since the start would not forget that.
class TimeLeft {
 public:
  /// @param done share of the job, 0 ... 1, not less than before; @param elapsed [s] since its
  /// start
  void note(double done, double elapsed);
  /// [s]; 0 before anything was noted
  double estimate() const;

 private:
  struct Note {
    double done, elapsed;
  };
  std::deque<Note> notes_ = {{0.0, 0.0}};  // those that the last third of the time needs
};

}  // namespace furrow

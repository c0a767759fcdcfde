// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Estimate of the remaining time of a job from its progress.

#include <deque>

namespace furrow {

/// The estimate uses the rate of the last third of the elapsed time, because the cost of a step
/// changes when the wheel touches the ground.
class TimeLeft {
 public:
  /// @param done share of the job, 0 ... 1, not less than before; @param elapsed [s] since its
  /// start
  void note(double done, double elapsed);
  /// Estimate of the time left [s]; 0 before anything was noted.
  double estimate() const;

 private:
  struct Note {
    double done, elapsed;
  };
  std::deque<Note> notes_ = {{0.0, 0.0}};  // notes that cover the last third of the time
};

}  // namespace furrow

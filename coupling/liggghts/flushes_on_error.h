// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Fixes that hold results in memory which must reach the disk when an error ends the run.

namespace furrow::coupling {

class FlushesOnError {
 public:
  virtual ~FlushesOnError() = default;
  /// Called on rank 0, once, while the run is being stopped. May throw.
  virtual void flush_results() = 0;
};

}  // namespace furrow::coupling

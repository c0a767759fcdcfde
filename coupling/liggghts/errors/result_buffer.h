// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Role of a fix with results in memory that must reach the disk when an error ends the run.

namespace furrow::coupling {

class ResultBuffer {
 public:
  virtual ~ResultBuffer() = default;
  /// Called on rank 0 while the run is being stopped, perhaps by another thread than the main one
  /// (rescue.h). May throw.
  virtual void flush_results() = 0;
};

}  // namespace furrow::coupling

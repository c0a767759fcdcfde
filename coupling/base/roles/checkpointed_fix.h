// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Role of a fix whose state checkpoints keep.

#include <string>
#include <utility>
#include <vector>

namespace furrow::coupling {

class CheckpointedFix {
 public:
  virtual ~CheckpointedFix() = default;
  /// True if a continued run needs the state that a checkpoint keeps of this fix.
  virtual bool must_be_restored() const = 0;
  /// True if the fix has its state from a checkpoint.
  virtual bool restored() const = 0;
  /// Keywords with their values, equal for equal numbers, but for those that may change when a run
  /// is continued. A file that is read may add its contents.
  virtual std::vector<std::pair<std::string, std::string>> settings() const { return {}; }
};

}  // namespace furrow::coupling

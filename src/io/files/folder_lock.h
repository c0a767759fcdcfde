// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A folder that one process writes to.

#include <string>

namespace furrow {

/// Held until the object goes or the process ends, however it ends (flock of the folder itself: no
/// file is left behind). On file systems that know no locks there is none.
class FolderLock {
 public:
  /// @param folder must be there
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  bool held_by_another() const { return held_by_another_; }

 private:
  int handle_;
  bool held_by_another_;
};

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A file that one process writes.

#include <string>

namespace furrow {

/// Held until the object goes or the process ends, however it ends (flock). On file systems without
/// locks there is none.
class FileLock {
 public:
  FileLock() = default;  ///< of nothing
  /// Locks an open file, and closes it at the end.
  explicit FileLock(int handle);
  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;

 private:
  int handle_ = -1;
};

/// True if someone, also in this process, holds the lock of a file that may be there.
bool is_locked(const std::string& path);

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/files/file_lock.h"

#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace furrow {

FileLock::FileLock(int handle) : handle_(handle) { flock(handle_, LOCK_EX | LOCK_NB); }

FileLock::~FileLock() {
  if (handle_ >= 0) close(handle_);
}

FileLock::FileLock(FileLock&& other) noexcept : handle_(std::exchange(other.handle_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(handle_, other.handle_);
  return *this;
}

/// With a shared lock: two that ask at once do not take each other for the holder.
bool is_locked(const std::string& path) {
  const int handle = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (handle < 0) return false;
  const bool locked = flock(handle, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  close(handle);
  return locked;
}

}  // namespace furrow

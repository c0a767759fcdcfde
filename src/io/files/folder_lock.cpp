// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/files/folder_lock.h"

#include <cerrno>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace furrow {

FolderLock::FolderLock(const std::string& folder)
    : handle_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)),
      held_by_another_(handle_ >= 0 && flock(handle_, LOCK_EX | LOCK_NB) != 0 &&
                       errno == EWOULDBLOCK) {}

FolderLock::~FolderLock() {
  if (handle_ >= 0) close(handle_);
}

}  // namespace furrow

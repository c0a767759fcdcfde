// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Files that are whole or absent, and whose readers can tell: written under another name, closed
/// by a seal (a last line with length and checksum), brought to the disk, then renamed.

#include <cstddef>
#include <cstdint>
#include <string>

#include "furrow/core/checksum.h"
#include "furrow/io/files/file_lock.h"

namespace furrow {

class SealedFile {
 public:
  /// Begins "<path>.part", in the place of one that a kill has left; no link is followed. Folders
  /// that are missing are made.
  /// @throws Error naming path and the system's reason, as write() and close() do; also when
  /// someone else is writing this file, or keeps its lock
  explicit SealedFile(std::string path);
  /// Removes the unfinished file unless close() was called; the previous file of that name stays.
  ~SealedFile();
  SealedFile(const SealedFile&) = delete;
  SealedFile& operator=(const SealedFile&) = delete;

  void write(const void* bytes, std::size_t count);
  /// Adds the seal and gives the file its name; it is then safe against a power failure too.
  /// @return the file's lock: whoever keeps it is the only one that may replace the file
  FileLock close();

 private:
  void write_all(const void* bytes, std::size_t count);
  [[noreturn]] void fail(const std::string& what, int reason) const;

  std::string path_, part_;
  int file_ = -1;
  FileLock lock_;
  std::uint64_t length_ = 0;  // without the seal [bytes]
  Checksum checksum_;
};

struct SealCheck {
  enum class State {
    whole,
    unreadable,  ///< missing, a folder, no permission
    unsealed,    ///< no SealedFile, or its end is missing
    damaged      ///< other bytes than were written
  };
  State state;
  std::string problem;  ///< "is empty"; nothing when it is whole
};

/// Reads a file through and compares it with its seal. Throws nothing.
SealCheck check_seal(const std::string& path);

/// A sealed text. @throws Error naming the path
void write_sealed_text(const std::string& path, const std::string& text);

}  // namespace furrow

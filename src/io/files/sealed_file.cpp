// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/files/sealed_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

namespace fs = std::filesystem;
using State = SealCheck::State;

/// Seal of a file: a separate last line, which readers of text and of LIGGGHTS's restart files pass
/// over. It has the same length for every file.
std::string seal(std::uint64_t length, const Checksum& checksum) {
  return fmt::format("\n# sealed by Furrow: {:016x} bytes, FNV-1a {:016x}\n", length,
                     checksum.value());
}
const std::size_t seal_length = seal(0, {}).size();

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

SealCheck unreadable(int reason) {
  return {State::unreadable, fmt::format("cannot be read: {}", std::strerror(reason))};
}

/// Some systems cannot synchronise a folder: the file is then as safe as they make it.
void synchronise_folder(const fs::path& folder) {
  const int handle = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (handle < 0) return;
  fsync(handle);
  close(handle);
}

}  // namespace

SealedFile::SealedFile(std::string path) : path_(std::move(path)), part_(path_ + ".part") {
  const fs::path folder = fs::path(path_).parent_path();
  std::error_code failed;
  if (!folder.empty()) fs::create_directories(folder, failed);
  if (failed) fail(fmt::format("its folder '{}' cannot be made", folder.string()), failed.value());
  if (fs::is_directory(path_, failed)) fail("it cannot be replaced", EISDIR);
  for (const std::string& file : {path_, part_})
    if (is_locked(file))
      throw Error(
          fmt::format("'{}' is not written: another run writes it too; give each run "
                      "separate names, or wait until the other has ended",
                      path_));
  unlink(part_.c_str());
  file_ = open(part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file_ < 0) fail(fmt::format("'{}' cannot be opened", part_), errno);
  lock_ = FileLock(file_);
}

SealedFile::~SealedFile() {
  if (file_ >= 0) unlink(part_.c_str());
}

void SealedFile::fail(const std::string& what, int reason) const {
  throw Error(fmt::format("'{}' is not written: {} ({})", path_, what, std::strerror(reason)));
}

void SealedFile::write_all(const void* bytes, std::size_t count) {
  const char* next = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t written = ::write(file_, next, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail("the write failed", written < 0 ? errno : ENOSPC);
    next += written;
    count -= static_cast<std::size_t>(written);
  }
}

void SealedFile::write(const void* bytes, std::size_t count) {
  write_all(bytes, count);
  checksum_.add(bytes, count);
  length_ += count;
}

FileLock SealedFile::close() {
  const std::string line = seal(length_, checksum_);
  write_all(line.data(), line.size());
  // Some file systems (NFS) report a full disk only now.
  if (fsync(file_) != 0 && errno != EINVAL && errno != EROFS) fail("the write failed", errno);
  if (std::rename(part_.c_str(), path_.c_str()) != 0) fail("it cannot be replaced", errno);
  file_ = -1;
  synchronise_folder(fs::path(path_).parent_path());
  return std::move(lock_);
}

SealCheck check_seal(const std::string& path) {
  std::error_code failed;
  const fs::file_status status = fs::status(path, failed);
  if (!fs::exists(status)) return unreadable(failed ? failed.value() : ENOENT);
  if (!fs::is_regular_file(status))
    return {State::unreadable, fs::is_directory(status) ? "is a folder" : "is no regular file"};
  const File file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) return unreadable(errno);
  const std::uintmax_t size = fs::file_size(path, failed);
  if (failed) return unreadable(failed.value());
  if (size == 0) return {State::unsealed, "is empty"};
  if (size < seal_length) return {State::unsealed, fmt::format("has only {} bytes", size)};

  Checksum checksum;
  std::array<char, 1 << 16> block;
  std::uint64_t left = size - seal_length;
  while (left > 0) {
    const std::size_t wanted = std::min<std::uint64_t>(left, block.size());
    if (std::fread(block.data(), 1, wanted, file.get()) != wanted)
      return unreadable(std::ferror(file.get()) ? errno : EIO);
    checksum.add(block.data(), wanted);
    left -= wanted;
  }
  std::string line(seal_length, '\0');
  if (std::fread(line.data(), 1, seal_length, file.get()) != seal_length)
    return unreadable(std::ferror(file.get()) ? errno : EIO);
  if (line == seal(size - seal_length, checksum)) return {State::whole, ""};
  const std::string mark = "\n# sealed by Furrow: ";
  if (line.compare(0, mark.size(), mark) != 0)
    return {State::unsealed, "has no seal of Furrow at its end"};
  return {State::damaged, fmt::format("is damaged: its {} bytes are not those that were written",
                                      size - seal_length)};
}

void write_sealed_text(const std::string& path, const std::string& text) {
  SealedFile file(path);
  file.write(text.data(), text.size());
  file.close();
}

}  // namespace furrow

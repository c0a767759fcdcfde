// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/files/rank_files.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "furrow/core/error.h"

namespace furrow {

RankFiles::RankFiles(std::string stem, int rank) : stem_(std::move(stem)), rank_(rank) {}

RankFiles::~RankFiles() {
  if (handle_ >= 0) ::close(handle_);
}

std::string RankFiles::path(int rank) const { return fmt::format("{}.{}", stem_, rank); }

void RankFiles::append(const double* numbers, std::size_t count) {
  if (count == 0 || !failure_.empty()) return;
  try {
    if (!written_) written_.emplace(path(rank_));
    written_->write(numbers, count * sizeof(double));
  } catch (const Error& error) {
    failure_ = error.what();
  }
}

std::string RankFiles::close() {
  if (failure_.empty() && written_) try {
      written_->close();
    } catch (const Error& error) {
      failure_ = error.what();
    }
  written_.reset();
  return failure_;
}

void RankFiles::refuse(int rank, const std::string& problem) const {
  const std::filesystem::path folder = std::filesystem::path(stem_).parent_path();
  throw Error(fmt::format(
      "the checkpoint is incomplete: its file '{}' {}; keep the folder '{}' next to the restart "
      "file that it belongs to, or continue from another checkpoint",
      path(rank), problem, folder.string()));
}

void RankFiles::check(int rank) {
  const SealCheck check = check_seal(path(rank));
  if (check.state != SealCheck::State::whole) refuse(rank, check.problem);
}

void RankFiles::open_file(int rank) {
  if (rank == open_rank_) return;
  if (handle_ >= 0) ::close(handle_);
  handle_ = open(path(rank).c_str(), O_RDONLY | O_CLOEXEC);
  if (handle_ < 0) refuse(rank, fmt::format("cannot be read: {}", std::strerror(errno)));
  open_rank_ = rank;
}

void RankFiles::read(int rank, std::uint64_t first, double* numbers, std::size_t count) {
  open_file(rank);
  char* next = reinterpret_cast<char*>(numbers);
  auto place = static_cast<off_t>(first * sizeof(double));
  for (std::size_t left = count * sizeof(double); left > 0;) {
    const ssize_t done = pread(handle_, next, left, place);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) refuse(rank, fmt::format("cannot be read: {}", std::strerror(errno)));
    if (done == 0) refuse(rank, "ends too early");
    next += done;
    place += done;
    left -= static_cast<std::size_t>(done);
  }
}

}  // namespace furrow

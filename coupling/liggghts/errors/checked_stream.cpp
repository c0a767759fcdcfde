// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/errors/checked_stream.h"

#include <cerrno>
#include <cstring>
#include <memory>
#include <utility>

#include <fmt/format.h>

namespace furrow::coupling {

namespace {

struct Checked {
  FILE* stream;
  std::string name;
};

std::string& failure() {
  static std::string text;
  return text;
}

void note_failure(const Checked& checked) {
  if (failure().empty()) failure() = fmt::format("{}: {}", checked.name, std::strerror(errno));
}

ssize_t write_on(void* cookie, const char* bytes, std::size_t size) {
  const auto& checked = *static_cast<const Checked*>(cookie);
  const std::size_t done = std::fwrite(bytes, 1, size, checked.stream);
  if (done == size && std::fflush(checked.stream) == 0) return static_cast<ssize_t>(done);
  note_failure(checked);
  return 0;  // the error of a cookie's stream
}

int seek_on(void* cookie, off64_t* place, int whence) {
  FILE* stream = static_cast<const Checked*>(cookie)->stream;
  if (fseeko64(stream, *place, whence) != 0) return -1;
  *place = ftello64(stream);
  return 0;
}

int close_with(void* cookie) {
  const std::unique_ptr<Checked> checked(static_cast<Checked*>(cookie));
  const int status = std::fclose(checked->stream);
  if (status != 0) note_failure(*checked);
  return status;
}

}  // namespace

FILE* checked_stream(FILE* stream, const std::string& name) {
  auto checked = std::make_unique<Checked>(Checked{stream, name});
  FILE* outer = fopencookie(checked.get(), "w", {nullptr, write_on, seek_on, close_with});
  if (!outer) return stream;
  checked.release();
  return outer;
}

std::string take_stream_failure() { return std::exchange(failure(), {}); }

}  // namespace furrow::coupling

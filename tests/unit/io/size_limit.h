// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A disk that is full, for tests of what is written.

#include <csignal>

#include <sys/resource.h>

namespace furrow {

/// Files of this process may grow to so many bytes; more gives "File too large".
class SizeLimit {
 public:
  explicit SizeLimit(rlim_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit = {bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }
  SizeLimit(const SizeLimit&) = delete;
  SizeLimit& operator=(const SizeLimit&) = delete;

 private:
  rlimit before_;
  void (*signal_)(int);
};

}  // namespace furrow

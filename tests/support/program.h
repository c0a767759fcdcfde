// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A program as a user runs it in a shell.

#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace furrow::test {

struct Outcome {
  bool ended = false;  ///< by itself, not by a signal
  int status = -1;
  std::string text;  ///< standard output and error
};

inline Outcome run_program(const std::string& command) {
  Outcome outcome;
  FILE* pipe = popen(("(" + command + ") 2>&1").c_str(), "r");
  if (!pipe) return outcome;
  char buffer[4096];
  while (const std::size_t size = fread(buffer, 1, sizeof buffer, pipe))
    outcome.text.append(buffer, size);
  const int status = pclose(pipe);
  outcome.ended = WIFEXITED(status) && WEXITSTATUS(status) < 128;  // a shell adds 128 to a signal
  outcome.status = WEXITSTATUS(status);
  return outcome;
}

}  // namespace furrow::test

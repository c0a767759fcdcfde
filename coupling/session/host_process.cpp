// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/session/host_process.h"

#include <cstdlib>

#include <mpi.h>
#include <unistd.h>

#include "furrow/core/error.h"
#include "coupling/liggghts/initialize_mpi.h"

namespace furrow::coupling {

namespace {

std::string mark_of_process() { return std::to_string(getpid()) + ":"; }

}  // namespace

bool start_mpi() {
  int initialized = 0, finalized = 0;
  MPI_Finalized(&finalized);
  if (finalized) throw Error("MPI has ended in this process; start another one");
  MPI_Initialized(&initialized);
  if (!initialized) initialize_mpi(nullptr, nullptr);
  return !initialized;
}

std::string shared_text(const char* variable) {
  const std::string mark = mark_of_process();
  const char* found = std::getenv(variable);
  const std::string text = found ? found : "";
  return text.rfind(mark, 0) == 0 ? text.substr(mark.size()) : "";
}

void share_text(const char* variable, const std::string& text) {
  setenv(variable, (mark_of_process() + text).c_str(), 1);
}

}  // namespace furrow::coupling

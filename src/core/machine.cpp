// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/core/machine.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

namespace furrow {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Number in a file; unlimited for "max" or a missing file.
double number_in(const std::string& path) {
  std::ifstream file(path);
  double value = 0.0;
  return file >> value ? value : unlimited;
}

/// Memory limit [bytes] of this process's control group and its parents, in either version of them.
double control_group_limit() {
  double limit = number_in("/sys/fs/cgroup/memory/memory.limit_in_bytes");
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    if (line.rfind("0::", 0) != 0) continue;
    std::string group = line.substr(3);
    for (;; group.resize(group.rfind('/'))) {
      limit = std::min(limit, number_in("/sys/fs/cgroup" + group + "/memory.max"));
      if (group.rfind('/') == std::string::npos) break;
    }
  }
  return limit;
}

}  // namespace

double usable_memory(int processes) {
  const double all =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  rlimit space;
  const bool limited = getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY;
  const double own = limited ? static_cast<double>(space.rlim_cur) * processes : unlimited;
  return std::min({all, control_group_limit(), own});
}

}  // namespace furrow

#include "io/run_report.h"

#include <sys/resource.h>

namespace furrow {

double peak_memory() {
  rusage usage{};
  return getrusage(RUSAGE_SELF, &usage) == 0 ? 1024.0 * double(usage.ru_maxrss) : 0.0;  // Linux counts in KiB
}

}  // namespace furrow

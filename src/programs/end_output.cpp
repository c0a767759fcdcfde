// SPDX-License-Identifier: GPL-2.0-or-later
#include "end_output.h"

#include <cstdio>
#include <iostream>

#include "furrow/core/error.h"

namespace furrow {

void end_output() {
  std::cout << std::flush;
  if (!std::cout || std::fflush(stdout) != 0 || std::ferror(stdout))
    throw Error("the standard output cannot be written; is the disk full?");
}

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
// The shell's kernel for any processor.
#define FURROW_ISA isa_baseline
#include "shell/shell4_kernel.h"

namespace furrow {
Shell4Result shell4_forces_baseline(const Shell4Kind* kinds, std::size_t count,
                                    const Shell4Places& places, const double* x,
                                    const double* rotation, double pressure, double* force,
                                    double* moment) {
  return shell4_forces(kinds, count, places, x, rotation, pressure, force, moment);
}
}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
// The kernels for every processor of the target; no special instructions.
#define FURROW_ISA isa_baseline
#include "material/kernels_all.h"

namespace furrow {
const Kernels& kernels_baseline() {
  static constexpr Kernels table = all_kernels("baseline");
  return table;
}
}  // namespace furrow

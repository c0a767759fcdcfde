// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The choice of kernels when the program starts.

#include <vector>

#include "material/kernel_table.h"

namespace furrow {

/// The tables that this build has and this processor runs, slowest first: baseline, avx2
/// (x86-64-v3), avx512 (x86-64-v4).
std::vector<const Kernels*> available_kernels();
/// The fastest of them. The environment variable FURROW_ISA = baseline | avx2 | avx512 asks for
/// another.
/// @throws InputError when it names one that is not available
const Kernels& kernels();

}  // namespace furrow

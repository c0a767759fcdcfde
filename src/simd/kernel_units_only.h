// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Stops the compiler where a header of kernels is included by a source file that is not a kernel
/// unit (simd/kernel_unit.cpp.in).

#ifndef FURROW_ISA
#error "headers of kernels are for kernel units, which name the instruction set"
#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Instruction sets that kernels are compiled for, as plain data: this header is compiled with
/// every one of them (simd/lanes.h explains why that matters).

namespace furrow {

enum class InstructionSet {
  baseline,  ///< any processor of the target
  avx2,      ///< x86-64-v3: AVX2 and FMA
  avx512     ///< x86-64-v4: AVX-512
};

/// Base of a table of kernels: pointers to functions that are compiled for one instruction set.
///   struct MyKernels : KernelTable {
///     void (*function)(...) = nullptr;
///
///     static const MyKernels& baseline();  // defined by the kernel units, one for each
///     static const MyKernels& avx2();      // instruction set (src/simd/kernel_unit.cpp.in)
///     static const MyKernels& avx512();
///   };
/// The header of the kernels has `constexpr void fill(MyKernels& kernels)`, which names every
/// function; kernels<MyKernels>() of simd/dispatch.h is the table to call.
struct KernelTable {
  InstructionSet instruction_set = InstructionSet::baseline;
};

}  // namespace furrow

#pragma once
/// The block updates of all laws, compiled once for each instruction set and chosen when the program starts.

#include "material/crushable_foam_parameters.h"
#include "material/drucker_prager_cap_parameters.h"
#include "material/elasticity_parameters.h"
#include "material/neo_hookean_parameters.h"
#include "material/point_block.h"

namespace furrow {

enum class Failure { none, folded, table_ends, not_finite };

/// Result of a block update as plain data: only material.cpp turns a failure into an exception.
struct BlockResult {
  UpdateReport report;
  Failure failure = Failure::none;
  std::size_t failed_point = 0;
};

/// One function a law.
struct Kernels {
  const char* instruction_set;
  int lanes;  ///< points updated at once
  BlockResult (*crushable_foam)(const CrushableFoamParameters&, double density, const PointBlock&);
  BlockResult (*drucker_prager_cap)(const DruckerPragerCapParameters&, double density, const PointBlock&);
  BlockResult (*elastic)(const ElasticityParameters&, double density, const PointBlock&);
  BlockResult (*neo_hookean)(const NeoHookeanParameters&, double density, const PointBlock&);
};

const Kernels& kernels_baseline();  ///< runs on every processor of the target
#ifdef FURROW_X86_KERNELS
const Kernels& kernels_avx2();    ///< x86-64-v3
const Kernels& kernels_avx512();  ///< x86-64-v4
#endif

/// The fastest that this processor runs. The environment variable FURROW_ISA = baseline | avx2 | avx512 asks for a lesser one.
/// @throws InputError when it names one that this processor or build does not have
const Kernels& kernels();

/// ln U and U^-1 of C = U^2 = I + X by eigenvalues, for the kernels' rare large steps. Components xx, yy, zz, xy, yz, xz.
/// False, with nothing written, when C is not finite or not positive definite.
bool large_stretch(const double* x, double* log_u, double* inverse_u);

}  // namespace furrow

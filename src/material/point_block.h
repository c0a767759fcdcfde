// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A block of material points as plain data for the update of a law (material.h), shared with the
/// kernels of every instruction set (simd/lanes.h explains why it must be plain).

#include <array>
#include <cstddef>
#include <cstdint>

namespace furrow {

/// [kg/m^3] limit of a snow's density, reported when met, never enforced
constexpr double ice_density = 917.0;

/// Branch of the law that a point followed in its last step.
enum class Branch : std::uint8_t { elastic, shear, transition, cap, tension };
constexpr std::size_t branch_count = 5;

/// Indices of the fields that every law keeps first, in this order; internal variables follow from
/// `internal` on.
namespace field {
enum : std::size_t {
  stress = 0,         ///< six Cauchy stresses xx, yy, zz, xy, yz, xz [Pa]
  volume_ratio = 6,   ///< J = V/V0, density = rho0/J
  stored_energy,      ///< elastic work [J/m^3 of reference volume]
  frozen_energy,      ///< plastic work that compaction stores and softening gives back [J/m^3]
  dissipated_energy,  ///< plastic work turned into heat, never decreases [J/m^3]
  internal
};
}

/// n points in structure-of-arrays layout, owned by the caller. Arrays may be unaligned; they must
/// not overlap.
struct PointBlock {
  std::size_t size = 0;
  /// H = Delta F - I of the step, row by row: xx, xy, xz, yx, ..., zz
  std::array<const double*, 9> gradient{};
  double* const* state = nullptr;  ///< state[f] is the array of field f of state_fields()
  std::uint8_t* branch = nullptr;  ///< Branch of each point, or null when nobody asks
  /// Duration of the step [s]; 0: infinitely fast. Only laws that depend on the rate use it.
  double time_step = 0.0;
};

/// Counts of an update of many points.
struct UpdateReport {
  std::array<std::size_t, branch_count> points{};  ///< by Branch
  std::size_t iterations = 0;                      ///< of the return mapping, summed over points
  std::size_t max_iterations = 0;                  ///< of one point
  /// points whose strength was extrapolated below the hardening data (loosened)
  std::size_t below_data = 0;
  /// points whose strength was extrapolated beyond the hardening data (compacted)
  std::size_t beyond_data = 0;
  std::size_t beyond_ice = 0;  ///< points denser than ice_density

  std::size_t size() const;
  UpdateReport& operator+=(const UpdateReport& other);
};

/// Reason why a law refused a step.
enum class Failure {
  none,
  folded,      ///< Delta F is not finite, or its determinant not positive
  table_ends,  ///< the hardening data end, and the rule there is to stop
  not_finite   ///< the new state
};

/// Result of a kernel's update of a block; material.cpp turns a failure into an exception.
struct BlockResult {
  UpdateReport report;
  Failure failure = Failure::none;
  std::size_t failed_point = 0;
};

/// A kernel's update of a block. @param density rho0 [kg/m^3]
template <class Parameters>
using BlockUpdate = BlockResult (*)(const Parameters& parameters, double density,
                                    const PointBlock& block);

}  // namespace furrow

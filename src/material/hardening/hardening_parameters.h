// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Constants of a hardening law, as plain data for the kernels.

namespace furrow {

struct HardeningParameters {
  enum class Kind { linear_table, log_table, exponential };
  static constexpr int max_segments = 63;

  Kind kind = Kind::linear_table;
  double first = 0.0;       ///< eps_vol_pl where the data begin
  double last = 1e300;      ///< end of the data
  bool stop_below = false;  ///< rules outside the data: stop, or extrapolate
  bool stop_beyond = false;
  double first_value = 0.0;  ///< strength at `first` [Pa]
  double decay = 0.0;        ///< below `first`: strength = first_value exp(decay (eps - first))

  int segments = 0;  ///< table: segment k holds from start[k] on
  double start[max_segments] = {};
  double base[max_segments] = {};   ///< strength at start[k] [Pa], or its logarithm
  double slope[max_segments] = {};  ///< of base

  double scale = 0.0;  ///< exponential: p0 + offset [Pa]
  double offset = 0.0;
  double c = 0.0;  ///< 1 + e0
  double lambda = 0.0;
  double kappa = 0.0;
};

}  // namespace furrow

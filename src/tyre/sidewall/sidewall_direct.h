// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A sidewall by solving its chain at every station: the reference for SidewallTable.

#include <vector>

#include "furrow/tyre/sidewall/sidewall_chain.h"

namespace furrow {

class SidewallDirect : public Sidewall {
 public:
  /// @throws InputError for bad parameters, StateError for a pressure < 0
  SidewallDirect(const SidewallParameters& parameters, double pressure);

  void evaluate(const SidewallEnd* ends, SidewallResponse* responses, std::size_t n,
                bool with_stiffness) override;
  double pressure() const override { return pressure_; }
  void set_pressure(double pressure) override;
  SidewallShape shape(const SidewallEnd& end) override { return chain_.shape(end, pressure_); }

 private:
  SidewallChain chain_;
  double pressure_;
  std::vector<VectorX> angles_;  // of each station, its last solution
};

}  // namespace furrow

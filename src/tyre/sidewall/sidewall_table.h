// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A sidewall by lookup: its potential W at one pressure as a smooth table, and the forces as its
/// exact gradient.
///
/// W (sidewall.h; theory: tyres, eq. 4) depends on the chord's length c and direction chi and on
/// the tread's rotation phi. It is tabulated over (u, chi, phi) with u = sqrt(1 - c/l), because W
/// has a square root at the stretched chain but is smooth in u. The spline is quintic: forces are
/// C3 and stiffness C2 in the interior. Around a closed path the forces do only the work of the
/// pressure, p times the area that the tread end sweeps, for any size of the table.

#include <array>
#include <vector>

#include "furrow/tyre/sidewall/quintic_spline.h"
#include "furrow/tyre/sidewall/sidewall_chain.h"

namespace furrow {

/// Range in which a table is valid, and its resolution.
struct SidewallTableGrid {
  double chord_min = 0.2, chord_max = 0.999;  ///< shares of the length
  /// chi [rad]: of the chord, from +a to +r
  double direction_min = radians(30), direction_max = radians(150);
  double rotation_min = radians(-60), rotation_max = radians(60);  ///< phi [rad]
  int chord_nodes = 32, direction_nodes = 12, rotation_nodes = 8;

  std::array<GridAxis, 3> axes() const;  ///< over u, chi, phi
};

class SidewallTable : public Sidewall {
 public:
  /// Solves the chain at every node of the grid, and compares with it between the nodes.
  /// @throws InputError for bad parameters; StateError for a pressure < 0, a bad grid, a node
  /// without stable equilibrium, or forces that differ from the chain's by more than 0.5 % (rms)
  SidewallTable(const SidewallParameters& parameters, double pressure,
                const SidewallTableGrid& grid = {});
  /// With the coefficients() of an equal table, from a file. @throws as above
  SidewallTable(const SidewallParameters& parameters, double pressure,
                const SidewallTableGrid& grid, std::vector<double> coefficients);

  const std::vector<double>& coefficients() const { return spline_.coefficients(); }
  const SidewallTableGrid& grid() const { return grid_; }

  /// @throws StateError for an end outside the grid, naming station, quantity and limits
  void evaluate(const SidewallEnd* ends, SidewallResponse* responses, std::size_t n,
                bool with_stiffness) override;
  double pressure() const override { return pressure_; }
  void set_pressure(double pressure) override;  ///< makes another table unless the pressure stays
  SidewallShape shape(const SidewallEnd& end) override { return chain_.shape(end, pressure_); }

  /// Difference from the chain in the middle of cells.
  struct Accuracy {
    std::size_t points = 0;
    double force_rms = 0.0, force_max = 0.0;    ///< |(F_a, F_r)| [N/m]
    double moment_rms = 0.0, moment_max = 0.0;  ///< M [N m/m]
    double force_scale = 0.0;                   ///< rms of the chain's force [N/m]
    double force_max_share = 0.0;               ///< largest error of a force over that force
  };
  /// @param chord_limit leaves out chords above this share of the length, where forces grow without
  /// bound
  /// @param every takes one cell of so many
  Accuracy accuracy(double chord_limit, int every = 1);

 private:
  void build();
  [[noreturn]] void refuse(const SidewallEnd& end, std::size_t station) const;

  SidewallChain chain_;
  double pressure_;
  SidewallTableGrid grid_;
  QuinticSpline3 spline_;
};

}  // namespace furrow

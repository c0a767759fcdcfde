// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Response of a sidewall to motions of its tread edge, by the chain and by the table: output of
/// furrow-sidewall.

#include <string>
#include <vector>

#include "furrow/tyre/sidewall/sidewall_table.h"

namespace furrow {

/// The tread edge moved along one direction from where it was made.
struct SidewallCurve {
  std::string name;           ///< deflection, lateral, rotation
  std::string meaning;        ///< of `moved`
  std::vector<double> moved;  ///< [m] or [rad]
  std::vector<SidewallEnd> ends;
  std::vector<SidewallResponse> solved, looked_up;
  std::vector<double> half_width;  ///< [m] largest distance of the sidewall from the mid-plane
};

struct SidewallSurvey {
  TyreParameters tyre;
  double pressure = 0.0;      ///< [Pa]
  SidewallEnd made;           ///< position of the tread edge as made
  SidewallResponse response;  ///< response at this position, with the shape of the chain
  SidewallShape shape;
  std::vector<SidewallCurve> curves;
  std::vector<double> deflections;         ///< [m] of the profiles
  std::vector<Eigen::Matrix2Xd> profiles;  ///< nodes (A, R) [m]
  SidewallTableGrid grid;
  SidewallTable::Accuracy accuracy;  ///< of all cells up to 0.97 of the length
};

/// Curves from a chord of a quarter of the length to one of 0.98 of it (or half-way to the length
/// from where it was made).
/// @param points of each curve, at least 2
/// @throws InputError, StateError as SidewallTable
SidewallSurvey survey_sidewall(const TyreParameters& tyre, double pressure, SidewallTable& table,
                               int points = 81);

}  // namespace furrow

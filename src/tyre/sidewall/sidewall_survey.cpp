// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/sidewall/sidewall_survey.h"

#include <algorithm>
#include <cmath>

#include "furrow/core/error.h"
#include "furrow/tyre/sidewall/sidewall_direct.h"

namespace furrow {

namespace {

constexpr double shortest = 0.25, longest = 0.98;  // chords over length

/// Profile in the tyre's section: A from the mid-plane, R from the axle.
Eigen::Matrix2Xd section(Sidewall& sidewall, const TyreParameters& tyre, const SidewallEnd& end) {
  Eigen::Matrix2Xd nodes = sidewall.shape(end).nodes;
  nodes.colwise() += Vector2(0.5 * tyre.bead_spacing, tyre.bead_radius);
  return nodes;
}

}  // namespace

SidewallSurvey survey_sidewall(const TyreParameters& tyre, double pressure, SidewallTable& table,
                               int points) {
  check(tyre);
  if (points < 2) throw StateError("sidewall survey: a curve needs two points at least");
  SidewallDirect direct(tyre.sidewall, pressure);
  SidewallSurvey survey;
  survey.tyre = tyre;
  survey.pressure = pressure;
  survey.grid = table.grid();
  survey.accuracy = table.accuracy(0.97);
  const Vector2 chord = tyre.sidewall_chord();
  survey.made = {chord[0], chord[1], 0.0};
  direct.evaluate(&survey.made, &survey.response, 1, true);
  survey.shape = direct.shape(survey.made);

  const double l = tyre.sidewall.length,
               furthest = l * std::max(longest, 0.5 * (1.0 + chord.norm() / l));
  const double a = chord[0], r = chord[1];
  const double highest = std::sqrt(furthest * furthest - a * a), lowest = std::min(r, shortest * l);
  const double sideways = std::sqrt(furthest * furthest - r * r) - std::abs(a);
  const auto add = [&](const std::string& name, const std::string& meaning, double from, double to,
                       auto end_at) {
    SidewallCurve curve{name, meaning, {}, {}, {}, {}, {}};
    for (int i = 0; i < points; ++i) {
      const double moved = from + (to - from) * i / (points - 1);
      const SidewallEnd end = end_at(moved);
      SidewallResponse solved, looked_up;
      direct.evaluate(&end, &solved, 1, true);
      table.evaluate(&end, &looked_up, 1, true);
      curve.moved.push_back(moved);
      curve.ends.push_back(end);
      curve.solved.push_back(solved);
      curve.looked_up.push_back(looked_up);
      curve.half_width.push_back(section(direct, tyre, end).row(0).maxCoeff());
    }
    survey.curves.push_back(std::move(curve));
  };
  add("deflection", "radial deflection of the tread edge [m]", r - highest, r - lowest,
      [&](double moved) {
        return SidewallEnd{a, r - moved, 0.0};
      });
  add("lateral", "axial motion of the tread edge, outwards [m]", -sideways, sideways,
      [&](double moved) {
        return SidewallEnd{a + moved, r, 0.0};
      });
  add("rotation", "rotation of the tread edge [rad]",
      std::max(radians(-45), table.grid().rotation_min),
      std::min(radians(45), table.grid().rotation_max), [&](double moved) {
        return SidewallEnd{a, r, moved};
      });

  for (int i = 0; i <= 5; ++i) {
    survey.deflections.push_back((r - lowest) * i / 5);
    survey.profiles.push_back(section(direct, tyre, {a, r - survey.deflections.back(), 0.0}));
  }
  return survey;
}

}  // namespace furrow

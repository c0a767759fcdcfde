// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Tyres and sidewalls that tests share, and finite differences of the responses of sidewalls.

#include <string>
#include <vector>

#include "furrow/io/inputs/tyre_file.h"
#include "furrow/tyre/darnell/darnell_tyre.h"
#include "furrow/tyre/sidewall/sidewall.h"
#include "furrow/tyre/tyre_parameters.h"

namespace furrow {

/// Tyre of shells 235/75 R15. @param pressure [Pa]
inline TyreParameters p235(double pressure) {
  TyreParameters tyre = read_tyre_file(FURROW_SOURCE_DIR "/inputs/tyres/p235_75r15.yaml");
  tyre.pressure = pressure;
  return tyre;
}

inline DarnellTyreSettings coarse(bool half) {
  DarnellTyreSettings settings;
  settings.across = 4;
  settings.around = 36;
  settings.half = half;
  return settings;
}

/// 235/75 R15, [Shoop2001] Table 8 (inputs/tyres/p235_75r15.yaml), with end springs of one's choice
/// [N m/rad per m].
inline SidewallParameters tr_sidewall(double rim_stiffness, double tread_stiffness) {
  SidewallParameters sidewall;
  sidewall.length = 0.161;
  sidewall.bending = {1.5, 0.15, 0.04, 0.04, 0.04, 0.04, 0.15, 0.5, 1.0};
  sidewall.curvature = {6.76, 7.63, 9.95, 8.62, 9.71, 9.01, 9.09, 14.49, 17.54};
  sidewall.rim_angle = radians(23);
  sidewall.tread_angle = radians(133);
  sidewall.rim_stiffness = rim_stiffness;
  sidewall.tread_stiffness = tread_stiffness;
  return sidewall;
}

/// The same between two meridians: narrower at the rim.
inline SidewallParameters tr_sector(double rim_stiffness, double tread_stiffness) {
  SidewallParameters sidewall = tr_sidewall(rim_stiffness, tread_stiffness);
  sidewall.bead_width = 0.208 / 0.3475;
  sidewall.taper = 1.0 / 0.3475;
  return sidewall;
}

/// N equal segments of one bending stiffness and curvature, pinned at both ends.
inline SidewallParameters uniform_sidewall(int segments, double length, double bending,
                                           double curvature) {
  SidewallParameters sidewall;
  sidewall.length = length;
  sidewall.bending.assign(static_cast<std::size_t>(segments - 1), bending);
  sidewall.curvature.assign(static_cast<std::size_t>(segments - 1), curvature);
  return sidewall;
}

/// Ends from a nearly stretched sidewall to one folded by a deep dent.
inline const std::vector<SidewallEnd> ends = {{-0.004, 0.1395, 0.0},
                                              {-0.004, 0.155, 0.05},
                                              {0.02, 0.1, -0.2},
                                              {-0.03, 0.07, 0.3},
                                              {0.02, 0.05, 0.1}};

inline SidewallEnd moved(SidewallEnd end, int component, double by) {
  (component == 0 ? end.a : component == 1 ? end.r : end.phi) += by;
  return end;
}

/// Five-point central differences of the force on the tread: the stiffness, of order h^4.
template <class Response>
Matrix3 stiffness_by_differences(Response response, const SidewallEnd& end, double h) {
  Matrix3 K;
  for (int j = 0; j < 3; ++j) {
    const auto force = [&](double by) -> Vector3 { return response(moved(end, j, by)).on_tread; };
    K.col(j) = -(8.0 * (force(h) - force(-h)) - (force(2 * h) - force(-2 * h))) / (12.0 * h);
  }
  return K;
}

/// The same of the potential: dW/d(a, r, phi).
template <class Response>
Vector3 gradient_by_differences(Response response, const SidewallEnd& end, double h) {
  Vector3 g;
  for (int j = 0; j < 3; ++j) {
    const auto W = [&](double by) -> double { return response(moved(end, j, by)).potential; };
    g[j] = (8.0 * (W(h) - W(-h)) - (W(2 * h) - W(-2 * h))) / (12.0 * h);
  }
  return g;
}

}  // namespace furrow

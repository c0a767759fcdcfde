#pragma once
/// What a sidewall does to tread and rim: forces, stiffness and potential for a position of the tread edge, whichever way they are
/// computed: SidewallDirect solves the chain, SidewallTable looks it up.
///
/// A sidewall is taken as a planar chain per unit width in the meridian plane (Shoop & Darnell; TR-01-16). Neglected: that
/// a strip between two meridians is narrower at the rim (R_bead/R_tread = 0.6), tension and shear along the circumference, its mass.
/// All values are per unit circumference of the tread, also those on the rim: a station that holds the width w of tread takes w times
/// them. A wheel's side sums its stations.
///
/// Pressure is a follower load with live normals. Let W = min over the chain's angles of (bending energy - p S), S the area between
/// chain and chord. W depends on the shape only; its gradient and the resultant of the pressure on the chord, half at each end, are
///   F_tread = -dW/d(a, r) + p/2 (r, -a),   M_tread = -dW/dphi,   F_rim = p (r, -a) - F_tread.
/// So dF_a/dr - dF_r/da = p: the force alone is no gradient, but W is tabulated and the rest is exact. With the pressure on the tread
/// band itself it adds up to the gas's work p dV.

#include <cstddef>

#include "core/types.h"

namespace furrow {

/// Tread end of a sidewall, seen from its bead.
struct SidewallEnd {
  double a = 0.0;    ///< [m] axial, outwards
  double r = 0.0;    ///< [m] radial, away from the axle
  double phi = 0.0;  ///< [rad] rotation of the tread edge from where it was made, from +a towards +r
};

struct SidewallResponse {
  Vector3 on_tread = Vector3::Zero();   ///< F_a, F_r [N/m], M [N m/m]; M turns from +a towards +r
  Vector3 on_rim = Vector3::Zero();     ///< the same at the bead
  Matrix3 stiffness = Matrix3::Zero();  ///< -d(on_tread)/d(a, r, phi); skew in (a, r) by the pressure's p/2
  double potential = 0.0;               ///< W [J/m]
};

class Sidewall {
 public:
  virtual ~Sidewall() = default;

  /// Responses of n stations. A direct solve starts a station from its own last solution, so a caller keeps their order.
  /// @param with_stiffness false leaves out the stiffness
  /// @throws StateError for an end that is not finite or cannot be reached, naming the station
  virtual void evaluate(const SidewallEnd* ends, SidewallResponse* responses, std::size_t n, bool with_stiffness) = 0;

  virtual double pressure() const = 0;             ///< [Pa]
  virtual void set_pressure(double pressure) = 0;  ///< from the next evaluation on; a table is made anew. @throws StateError
  /// The nodes from bead (0, 0) to tread end (a, r), for pictures and for contact of the sidewall; N + 1 columns [m].
  virtual void profile(const SidewallEnd& end, Eigen::Matrix2Xd& nodes) = 0;
  /// Bending energy of hinges and end springs [J/m] and area S between chain and chord [m^2]: W = energy - p S.
  struct Energy {
    double bending = 0.0, area = 0.0;
  };
  virtual Energy energy(const SidewallEnd& end) = 0;
};

}  // namespace furrow

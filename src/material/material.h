// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A constitutive law: parameters, the state of a point, and one update. No mesh, no MPI, no files.
///
/// Finite strain is treated once, for every law (material/kinematics.h). With the displacement
/// gradient H of a step, measured from the configuration at its start (H = dt grad v), Delta F = I
/// + H = R U: the law sees the logarithmic strain increment ln U in the frame of the start of the
/// step, and the new stress is turned by R:
///   sigma_{n+1} = R law(sigma_n, ln U) R^T.
/// A rigid spin turns the stress exactly; for steps -> 0 this is the Jaumann (corotational) rate of
/// the Cauchy stress, with a global error of second order in the step. A hyperelastic law
/// (neo-Hookean) updates its own deformation instead.
///
/// Signs and invariants: core/types.h. Energies are per unit of reference volume: d(energy) = J
/// (energy per current volume).

#include <string>
#include <vector>

#include "core/error.h"
#include "core/types.h"
#include "material/point_block.h"

namespace furrow {

/// symmetric tensor: xx, yy, zz, xy, yz, xz (tensor components, no factor 2)
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

std::string to_string(Branch branch);

/// One scalar that a law keeps for a point.
struct StateField {
  std::string name;     ///< "eps_vol_pl"
  std::string unit;     ///< "Pa", "" when it has none
  std::string meaning;  ///< "compressive volumetric plastic strain"
  double initial;       ///< at the start of a run
};

/// A law refused the step of a point.
class PointError : public StateError {
 public:
  PointError(std::size_t place, const std::string& message) : StateError(message), point(place) {}
  std::size_t point;  ///< its place in the block
};

struct BlockResult;  // kernel_table.h

/// Stiffness against an infinitesimal elastic step: the bound for the explicit time step and the
/// start of a Newton iteration.
struct ElasticModuli {
  double bulk = 0.0;                                        ///< [Pa]
  double shear = 0.0;                                       ///< [Pa]
  double wave() const { return bulk + 4.0 / 3.0 * shear; }  ///< P-wave (constrained) modulus [Pa]
};

/// Base of all laws. Immutable after creation and safe to share between threads. Created by
/// make_material() (registry.h).
class Material {
 public:
  virtual ~Material() = default;
  Material(const Material&) = delete;
  Material& operator=(const Material&) = delete;

  const std::string& name() const { return name_; }
  double density() const { return density_; }  ///< in the reference configuration, rho0 [kg/m^3]
  const std::vector<StateField>& state_fields() const { return fields_; }
  /// Place of a field in the state. @throws Error for an unknown name
  std::size_t field_index(const std::string& name) const;

  /// One step of every point of a block. Not all-or-nothing: after a throw the states of the block
  /// are unspecified.
  /// @throws PointError when a result is not finite, Delta F is not invertible with positive
  /// determinant, or the hardening
  ///         table ends under the rule "stop"
  virtual UpdateReport update_block(const PointBlock& block) const = 0;

  // ---- one point: `state` has state_fields().size() values in the order of state_fields() -------
  VectorX initial_state() const;
  /// One step of one point. The result is that of update_block() to rounding. @throws StateError
  UpdateReport update_point(const Matrix3& gradient, VectorX& state,
                            Branch* branch = nullptr) const;
  /// Derivative of the new stress with respect to the strain of the step, consistent with the
  /// algorithm: column j is the change of the six stresses for a change of symmetric H_j (both
  /// places for a shear). Central differences, relative error ~1e-8 where the law is smooth. [Pa]
  /// @throws StateError
  Matrix6 tangent(const Matrix3& gradient, const VectorX& state) const;

  virtual ElasticModuli moduli(const VectorX& state) const = 0;
  double current_density(const VectorX& state) const {
    return density_ / state[field::volume_ratio];
  }
  /// Speed of the fastest elastic wave [m/s]. Associated flow is slower. Flow that is not
  /// associated can be stiffer than elasticity in one direction (found: modulus 0.5 % for the cap
  /// law, factor 2 for the foam of TR Table 1): leave the explicit step a margin.
  double wave_speed(const VectorX& state) const;
  /// The largest of a block's wave speeds [m/s].
  virtual double largest_wave_speed(const PointBlock& block) const;

  /// Yield function of the state [Pa]: <= 0 inside; minus infinity for a law that never yields.
  /// Where several surfaces meet (cap, shear, tension cut-off), the largest.
  virtual double yield_function(const VectorX& state) const;
  /// The stress that an error of the yield function is compared with [Pa]: the strength or the
  /// pressure, and at least 1e-8 of the wave modulus, below which the rounding of a strain is felt.
  virtual double stress_scale(const VectorX& state) const = 0;
  /// The yield surface of the state in triaxial compression as points (p, q), from the tensile end
  /// to the tip of the cap; empty for a law that never yields.
  virtual std::vector<Vector2> yield_surface(const VectorX& state, std::size_t points = 200) const;

 protected:
  /// @param internal_variables  what the law keeps after the common fields
  /// @param pressure    at the start of a run [Pa]
  Material(std::string name, double density, std::vector<StateField> internal_variables,
           double pressure = 0.0);
  /// The report of a kernel's update, or its failure. @throws StateError
  UpdateReport checked(const BlockResult& result, const PointBlock& block) const;

 private:
  std::string name_;
  double density_;
  std::vector<StateField> fields_;
};

/// Invariants of a stress, conventions of core/types.h.
struct Invariants {
  double p;  ///< pressure, compression positive [Pa]
  double q;  ///< Mises stress [Pa]
  /// (r/q)^3 = (27/2) det s / q^3: -1 in triaxial compression, +1 in extension; -1 when q = 0
  double cos_3t;
};
Invariants invariants(const Vector6& stress);
/// t = (q/2) [1 + 1/K - (1 - 1/K)(r/q)^3] with the flow stress ratio K: q in triaxial compression,
/// q/K in extension [Pa].
double yield_measure(const Invariants& stress, double flow_ratio);
inline Vector6 stress_of(const VectorX& state) { return state.segment<6>(field::stress); }
Matrix3 to_matrix(const Vector6& symmetric);
Vector6 to_vector6(const Matrix3& symmetric);

}  // namespace furrow

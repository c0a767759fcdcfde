// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The interface of a constitutive law: parameters, the state of a point, and one update. No mesh,
/// no MPI, no files.
///
/// Finite strain is treated in one place for every law (kinematics.h). A law receives the
/// logarithmic strain increment of the step, in the frame of its start. The stress is rotated
/// afterwards (theory: laws, eq. 2). A hyperelastic law (neo-Hookean) updates its own deformation
/// instead.
///
/// Signs and invariants: core/types.h. Energies are per unit of reference volume: d(energy) = J
/// (energy per current volume).

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "furrow/core/error.h"
#include "furrow/core/types.h"
#include "furrow/material/point_block.h"

namespace furrow {

/// symmetric tensor: xx, yy, zz, xy, yz, xz (tensor components, no factor 2)
using Vector6 = Eigen::Matrix<double, 6, 1>;
/// Names of the components of strain and stress, in the order of Vector6.
inline constexpr std::array<const char*, 6> component_names{"xx", "yy", "zz", "xy", "yz", "xz"};

std::string to_string(Branch branch);

/// State variable of a point: a number, or a symmetric tensor that rotates with the material.
struct StateVariable {
  enum class Kind { scalar, symmetric_tensor };

  std::string name;      ///< "eps_vol_pl"
  std::string unit;      ///< "Pa", "" when it has none
  std::string meaning;   ///< "compressive volumetric plastic strain"
  double initial = 0.0;  ///< at the start of a run; of a tensor: its diagonal
  Kind kind = Kind::scalar;
};

/// One number of the state: a scalar, or a component of a tensor.
struct StateField {
  std::string name;     ///< "eps_vol_pl"
  std::string unit;     ///< "Pa", "" when it has none
  std::string meaning;  ///< "compressive volumetric plastic strain"
  double initial;       ///< at the start of a run
};

/// A law refused the step of a point.
class PointError : public StateError {
 public:
  PointError(std::size_t index, const std::string& message) : StateError(message), point(index) {}
  std::size_t point;  ///< its index in the block
};

/// Stiffness against an infinitesimal elastic step: the bound for the explicit time step and the
/// start of a Newton iteration.
struct ElasticModuli {
  double bulk = 0.0;                                        ///< [Pa]
  double shear = 0.0;                                       ///< [Pa]
  double wave() const { return bulk + 4.0 / 3.0 * shear; }  ///< P-wave (constrained) modulus [Pa]
};

/// Base of all laws. Immutable after creation and safe to share between threads. Created by
/// make_material() (registry.h). A law derives from it and has kernels for blocks of points
/// (models/elastic is the shortest), or derives from PointwiseMaterial and has one function in
/// plain doubles (pointwise_material.h).
class Material {
 public:
  virtual ~Material() = default;
  Material(const Material&) = delete;
  Material& operator=(const Material&) = delete;

  const std::string& name() const { return name_; }
  double density() const { return density_; }  ///< in the reference configuration, rho0 [kg/m^3]
  /// Every number of a point's state, in order: those of namespace field, then the internal
  /// variables.
  const std::vector<StateField>& state_fields() const { return fields_; }
  /// Index of a field by its name; none when the law does not keep it.
  std::optional<std::size_t> find_field(const std::string& name) const;
  /// The first of the six fields (xx, yy, zz, xy, yz, xz) of each symmetric tensor of the state: of
  /// the stress, then of internal variables.
  const std::vector<std::size_t>& tensor_fields() const { return tensors_; }
  /// The stress after a step depends on its duration: such a law needs PointBlock::time_step.
  virtual bool rate_dependent() const { return false; }
  /// The stress can fall at once when a point yields: only the smoothing of a grid reset in every
  /// step damps the waves that follow (terrain/continuum, remap_interval).
  virtual bool stress_has_jumps() const { return false; }

  /// Takes one step of every point of a block. Not all-or-nothing: after a throw the states of the
  /// block
  /// are unspecified.
  /// @throws PointError when a result is not finite, Delta F is not invertible with positive
  /// determinant, the hardening data end under the rule "stop", or the law itself refuses
  virtual UpdateReport update_block(const PointBlock& block) const = 0;

  // ---- one point: `state` has state_fields().size() values in the order of state_fields() -------
  VectorX initial_state() const;
  /// Takes one step of one point. The result is that of update_block() to rounding.
  /// @param time_step  [s], as PointBlock::time_step
  /// @throws PointError
  UpdateReport update_point(const Matrix3& gradient, VectorX& state, Branch* branch = nullptr,
                            double time_step = 0.0) const;
  /// The state after a rigid rotation of the material; its tensors rotate, T -> R T R^T.
  VectorX rotated(const VectorX& state, const Matrix3& rotation) const;

  virtual ElasticModuli moduli(const VectorX& state) const = 0;
  double current_density(const VectorX& state) const {
    return density_ / state[field::volume_ratio];
  }
  /// Speed of the fastest elastic wave [m/s]. Associated flow is slower. Flow that is not
  /// associated can be stiffer than elasticity in one direction. The cap law is 0.5 % stiffer, and
  /// the foam of [Shoop2001] twice as stiff. The explicit step needs a margin.
  double wave_speed(const VectorX& state) const;
  /// The largest of a block's wave speeds [m/s].
  virtual double largest_wave_speed(const PointBlock& block) const;

  /// Yield function of the state [Pa]: <= 0 inside; minus infinity for a law that never yields.
  /// Where several surfaces meet (cap, shear, tension cut-off), the largest.
  virtual double yield_function(const VectorX& state) const;
  /// The stress that an error of the yield function is compared with [Pa]: the strength or the
  /// pressure, and at least rounding_stress(). A law that never yields has the wave modulus.
  virtual double stress_scale(const VectorX& state) const { return moduli(state).wave(); }
  /// Points (p, q) of the yield surface in triaxial compression. They begin at the tensile end and
  /// stop at the tip of the cap. A law that never yields has none.
  virtual std::vector<Vector2> yield_surface(const VectorX& state, std::size_t points = 200) const;

 protected:
  /// @param internal_variables  what the law keeps after the common fields
  /// @param pressure    at the start of a run [Pa]
  Material(std::string name, double density, const std::vector<StateVariable>& internal_variables,
           double pressure = 0.0);
  /// Stress below which the rounding of a strain matters [Pa].
  double rounding_stress(const VectorX& state) const { return 1e-8 * moduli(state).wave(); }
  /// The report of a kernel's update. @throws PointError when the kernel failed
  UpdateReport checked(const BlockResult& result, const PointBlock& block) const;
  /// @throws PointError with the cause, the step and the state of a point of the block
  [[noreturn]] void refuse(const PointBlock& block, std::size_t point,
                           const std::string& cause) const;

 private:
  std::string name_;
  double density_;
  std::vector<StateField> fields_;
  std::vector<std::size_t> tensors_;
};

/// Invariants of a stress, conventions of core/types.h.
struct Invariants {
  double p;  ///< pressure, compression positive [Pa]
  double q;  ///< Mises stress [Pa]
  /// (r/q)^3 = (27/2) det s / q^3. It is -1 in triaxial compression and +1 in extension. Without
  /// shear, q = 0, it is -1.
  double cos_3t;
};
Invariants invariants(const Vector6& stress);
/// Yield measure t = (q/2) [1 + 1/K - (1 - 1/K)(r/q)^3], with the flow stress ratio K [Pa]. It is q
/// in triaxial compression and q/K in extension.
double yield_measure(const Invariants& stress, double flow_ratio);
/// The stress of a state [Pa].
inline Vector6 stress_of(const VectorX& state) { return state.segment<6>(field::stress); }
Matrix3 to_matrix(const Vector6& symmetric);
Vector6 to_vector6(const Matrix3& symmetric);

}  // namespace furrow

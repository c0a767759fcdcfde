// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A mesh of co-rotational four-node shells: large displacements and rotations, small strains.

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "furrow/shell/shell4_stiffness.h"
#include "furrow/shell/shell_nodes.h"

namespace furrow {

struct Shell4Kind;

/// Rule that turns an element's axes in its plane.
enum class Shell4Turning {
  polar,  ///< the rotation of the polar decomposition: no direction is preferred
  /// the first median: the stretch along it is that of its fibres. In shear the fibres slide past
  /// each other, and their tension does no work (see Shell4).
  first_median
};

/// Elements of equal stress-free shape share one stiffness matrix (a tyre has one for each row),
/// which keeps the matrices in the fastest memory. Several elements are computed at once
/// (shell4_kernel.h).
///
/// Rotary inertia: with the real J = m h^2/12 the rotation of the nodes would be the fastest motion
/// of a thin shell and limit the step. An element's J is raised until no rotation at fixed
/// positions is faster than the fastest displacement without rotation (theory: tyres, eq. 2).
/// Bending waves not much longer than an element are slower therefore.
///
/// Tension and shear: strains are those of the stretch U in the turned axes. Fibres along 1 that
/// slide past each other make a simple shear gamma. Polar axes then have U_11 - 1 = -gamma^2/8 and
/// U_22 - 1 = 3 gamma^2/8, so the stiffness against shear is G - N_1/4 + 3 N_2/4 under the tensions
/// N_1 and N_2. It is negative when N_1 > 4 G + 3 N_2. Axes that follow the fibres have U_11 = 1
/// and the stiffness G. For a wall of cords whose tension exceeds its shear stiffness, such as an
/// inflated sidewall, use Shell4Turning::first_median with the quads' first median along the cords.
class Shell4 {
 public:
  using Quad = std::array<int, 4>;  ///< nodes counter-clockwise seen from outside

  /// @param reference stress-free nodes [m]
  /// @param fibre direction of the section's axis 1 at a point, e.g. the circumference; need not be
  /// tangent
  /// @param turning of the element's axes
  /// @param largest_kink [rad] as in shell4_elements() of shell4_shape.h
  /// @throws StateError naming the element for a degenerate or folded one
  Shell4(const Matrix3X& reference, std::vector<Quad> quads, const ShellSection& section,
         const std::function<Vector3(const Vector3&)>& fibre,
         Shell4Turning turning = Shell4Turning::polar, double largest_kink = radians(40.0));
  ~Shell4();
  Shell4(Shell4&&) noexcept;

  /// Adds forces and moments of the shell, and those of a pressure on its inner side (outwards), to
  /// nodes.force and .moment.
  /// @throws StateError naming an element that is folded, i.e. with a node rotated by 120 degrees
  /// against it, or whose nodes are not finite
  void add_forces(ShellNodes& nodes, double pressure);

  double energy() const { return energy_; }  ///< [J] elastic, at the last add_forces
  /// Volume inside a closed shell [m^3]: a third of the integral of x . n dA, at the last
  /// add_forces.
  double volume() const { return volume_; }
  const std::vector<Quad>& quads() const { return quads_; }
  /// Mass of the nodes [kg]: a quarter of each element.
  const VectorX& mass() const { return mass_; }
  const VectorX& rotary_inertia() const { return inertia_; }  ///< [kg m^2] raised, see above
  /// Stable step [s]: 2/omega of the stiffest element, stress-free.
  double stable_time_step() const { return stable_step_; }
  std::size_t kind_count() const;  ///< distinct stiffness matrices

 private:
  struct Places;  // of the elements in the kernel's arrays, kind by kind
  void add_kind(const std::vector<Shell4Element>& elements, const std::vector<int>& members,
                const ShellSection& section, Shell4Turning turning);

  std::vector<Quad> quads_;
  std::vector<Shell4Kind> kinds_;
  std::unique_ptr<Places> places_;
  VectorX mass_;              // [kg]
  VectorX inertia_;           // [kg m^2]
  double stable_step_ = 0.0;  // [s]
  double energy_ = 0.0;       // [J]
  double volume_ = 0.0;       // [m^3]
};

}  // namespace furrow

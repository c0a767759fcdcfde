// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A mesh of eight-node bricks of nearly incompressible rubber: any displacement, rotation and
/// strain (theory: tyres, eq. 6).

#include <array>
#include <memory>
#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/core/types.h"
#include "furrow/solid/brick8_shape.h"
#include "furrow/material/models/neo_hookean/neo_hookean_parameters.h"

namespace furrow {

struct Brick8Kind;

struct Rubber {
  NeoHookeanParameters law;
  double density = 0.0;  ///< [kg/m^3]
};

/// Elements of equal stress-free shape share their gradients (a tyre has one set for each brick of
/// a section), which keeps these in the fastest memory. Several elements are computed at once
/// (brick8_kernel.h).
class Brick8 {
 public:
  /// Nodes 0 to 3 run round one face, counter-clockwise seen from the opposite face. Nodes 4 to 7
  /// are the corresponding corners of that face. Nodes may be repeated to form a wedge.
  using Hexahedron = std::array<int, 8>;

  /// @param reference stress-free nodes [m]
  /// @throws StateError naming the element for one without volume or turned inside out
  Brick8(const Matrix3X& reference, std::vector<Hexahedron> bricks, const Rubber& rubber);
  ~Brick8();
  Brick8(Brick8&&) noexcept;

  /// Adds the forces at the nodes' positions.
  /// @throws StateError naming an element that is turned inside out at a Gauss point, or whose
  /// nodes are not finite
  void add_forces(const Matrix3X& x, Matrix3X& force);

  double energy() const { return energy_; }  ///< [J] elastic, at the last add_forces
  const std::vector<Hexahedron>& bricks() const { return bricks_; }
  const VectorX& mass() const { return mass_; }  ///< [kg] lumped, of all nodes
  /// Stable step [s]: 2/omega of the fastest element, no longer than that of the assembled mesh:
  /// exact for the
  /// stress-free state, and then an estimate at the last add_forces (brick8_kernel.h, rate_now()).
  double stable_time_step() const;
  /// Smallest volume over stress-free volume at a Gauss point, at the last add_forces.
  double minimum_volume_ratio() const { return minimum_ratio_; }
  std::size_t kind_count() const;      ///< distinct stress-free shapes
  void checkpoint(Checkpoint& state);  ///< state of stable_time_step()

 private:
  struct Alike;   // elements of one kind
  struct Places;  // of the elements in the kernel's arrays, kind by kind
  void add_kind(const Alike& alike, const VectorX& stiffness, const Rubber& rubber);
  const Hexahedron& nodes_of(int e) const { return bricks_[static_cast<std::size_t>(e)]; }

  std::vector<Hexahedron> bricks_;
  std::vector<Brick8Kind> kinds_;
  std::unique_ptr<Places> places_;
  VectorX mass_;               // [kg]
  double highest_rate_ = 0.0;  // omega^2 [1/s^2]
  double energy_ = 0.0;        // [J]
  double minimum_ratio_ = 1.0;
};

}  // namespace furrow

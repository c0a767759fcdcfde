// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Contact of a body with a height field by the soil contact model [Krenn2009] (theory: scm).

#include <limits>
#include <optional>
#include <vector>

#include "furrow/bodies/body.h"
#include "furrow/bodies/contact.h"
#include "furrow/scm/footprint.h"
#include "furrow/scm/height_field.h"
#include "furrow/scm/soil.h"

namespace furrow {

/// Pressure acts normal to the surface of the body, and depends on the sinkage of the cell below.
/// Shear stress acts along it. The body must be replicated: every rank computes the same.
class ScmContact : public Contact {
 public:
  struct Settings {
    std::optional<double> width;  ///< b in k_c/b [m]; none: of the present contact patch
    /// friction of the body's surface and the soil, up to the strength of the soil; infinity: that
    /// strength
    double friction = std::numeric_limits<double>::infinity();
    std::optional<double> slip_length = {};  ///< [m] in the place of K, for this friction; none: K
    bool records = true;  ///< true if this rank adds forces to the contact record of the body
  };
  /// Results of the last apply(); in a half model, of the half.
  struct Step {
    Vector3 force = Vector3::Zero();           ///< on the body [N]
    double area = 0.0;                         ///< in contact, seen from above [m^2]
    double width = 0.0;                        ///< b in k_c/b [m]; 0 without contact or k_c
    double pressure = 0.0;                     ///< largest [Pa]
    double sinkage = 0.0;                      ///< largest [m]
    double stored = 0.0;                       ///< elastic energy of the soil below the body [J]
    Vector3 of_steep_faces = Vector3::Zero();  ///< part of the force [N]; not in checkpoints
  };
  /// Losses since the start [J]; in a half model, of the half.
  struct Losses {
    double compaction = 0.0;  ///< plastic work of the pressure
    double shear = 0.0;       ///< work of the shear stress
    double damping = 0.0;     ///< work of the damping
  };

  /// Body and field must outlive the contact.
  ScmContact(Body& body, HeightField& field, SoilPatches soils, const Settings& settings);

  /// @throws StateError when the body presses next to the field
  void apply(double dt) override;
  const Step& step() const { return step_; }
  const Losses& losses() const { return losses_; }
  void checkpoint(Checkpoint& state);

 private:
  void find_contacts();
  double patch_width();
  bool is_inside(std::size_t slot) const;
  const Soil& soil_below(std::size_t slot) const {
    return soils_.at(field_.centre(footprint_.cells().cell[slot]));
  }
  double shear_length(std::size_t first, std::size_t end) const;
  void press(double dt);
  void find_descent();
  void shear(double dt);
  void shear_triangle(std::size_t first, std::size_t end, double dt);
  Vector3 place_of(std::size_t piece, const Matrix3X& nodal) const;
  void move_soil();

  Body& body_;
  HeightField& field_;
  SoilPatches soils_;
  Settings settings_;
  Footprint footprint_;
  Step step_;
  Losses losses_;
  // Shear of each triangle: the mobilised share of the strength along its first edge and normal to
  // it, as a force on the body, and the area in contact [m^2].
  Eigen::Matrix2Xd mobilised_;
  VectorX sheared_area_, next_area_;
  // Values of each covered cell.
  std::vector<double> pressure_;        // [Pa]
  std::vector<double> descent_;         // of the surface of the body [m/s]
  std::vector<double> pressed_;         // permanent sinkage of this step [m]
  std::vector<unsigned char> touches_;  // 1: in contact
  std::vector<Vector2> points_, hull_;  // of the patch [m]
  struct Column {
    double volume = 0.0;           // [m^3] displaced
    int lowest = 0, highest = -1;  // rows that the body covers
  };
  std::vector<Column> flow_;  // of each column of the field that the body covers
};

}  // namespace furrow

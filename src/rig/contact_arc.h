// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Stress and slip along the arc in which a wheel touches the ground.

#include <vector>

#include "furrow/bodies/contact_record.h"
#include "furrow/bodies/wheel_hub.h"

namespace furrow {

/// Sums of contacts over the angle theta about the axle (theory: resistance, eq. 7). theta is 0 at
/// the lowest point, > 0 ahead, and reaches 90 degrees to either side.
///
/// The unit vector e_r points from the axle to the contact, and e_t = e_r x a along the rim, where
/// a is the axle. F is the force on the wheel, and v the velocity of the rim over the ground. A
/// sector is the area A of a cylinder of the nominal width and radius. Its means over the time T
/// are:
///   normal stress  sigma = - int F . e_r dt/(T A).
///   shear stress   tau   =   int F . e_t dt/(T A). Positive drives the wheel forward.
///   slip velocity  v_s   = - int (F . e_r)(v . e_t) dt/int F . e_r dt. Positive means that the rim
///                            moves backwards over the ground.
class ContactArc : public ContactRecord {
 public:
  struct Profile {
    std::vector<double> angle;   ///< [rad] middle of each sector
    std::vector<double> normal;  ///< [Pa]
    std::vector<double> shear;   ///< [Pa]
    std::vector<double> slip;    ///< [m/s]; 0 where nothing presses
  };

  /// The hub must outlive it. @param sectors in 180 degrees
  ContactArc(const WheelHub& hub, std::size_t sectors);

  void add(const Vector3& point, const Vector3& force, const Vector3& sliding, double dt) override;

  std::vector<double>& sums() { return sums_; }  ///< for a sum over ranks and checkpoints
  /// @param sums of all ranks; @param duration T [s]
  Profile profile(const std::vector<double>& sums, double duration) const;

 private:
  const WheelHub& hub_;
  std::size_t sectors_;
  std::vector<double> sums_;  // of each sector: normal, shear [N s], normal times slip [N m]
};

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix cell/servo: a periodic cell of grains under prescribed strain rates and stresses. See
/// fix_cell_servo.md.

#include <array>

#include "coupling/base/furrow_fix.h"
#include "coupling/liggghts/data/box_motion.h"

namespace furrow::coupling {

class FixCellServo : public FurrowFix {
 public:
  FixCellServo(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static const Outputs<FixCellServo>& outputs();

  int setmask() override;
  void post_create() override;
  void init() override;
  void initial_integrate(int vflag) override;
  void end_of_step() override;

 private:
  /// True, so that the rules of the scene (coupling/checks) apply.
  bool needs_system() const override { return true; }
  struct Axis {
    enum class Control { hold, rate, stress } control = Control::hold;
    // strain rate, compression positive [1/s], or normal stress, compression positive [Pa]
    double target = 0.0;
    double integral = 0.0;  // of the controller [1/s]
    double rate = 0.0;      // of the last step [1/s]
  };

  void checkpoint(Checkpoint& state) override;
  std::array<double, 3> rates() const;
  double density() const;          // [kg/m^3]
  double inertial_number() const;  // of the cell now
  void check_rates() const;
  void check_stresses() const;
  void check_other_box_changes() const;
  void measure();
  double next_rate(Axis& axis, double stress) const;
  void move_box();

  std::array<Axis, 3> axes_;
  double rate_limit_;     // [1/s]
  double stiffness_;      // [Pa]
  double response_time_;  // [s]
  double ramp_time_;      // [s]
  BoxMotion box_;
  double elapsed_ = 0.0;            // [s]
  std::array<double, 3> stress_{};  // [Pa] compression positive
  double mass_ = 0.0;               // [kg] of all grains
  double mean_diameter_ = 0.0;      // [m]
  double grain_density_ = 0.0;      // [kg/m^3]
};

}  // namespace furrow::coupling

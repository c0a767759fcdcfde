// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix cell/servo: a periodic cell of grains under prescribed strain rates and stresses. See
/// fix_cell_servo.md.

#include <array>

#include "coupling/output/effective_input.h"
#include "fix.h"

namespace furrow::coupling {

class FixCellServo : public LAMMPS_NS::Fix, public HasOptions {
 public:
  FixCellServo(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();

  int setmask() override;
  void post_create() override;
  void pre_delete(bool unfixflag) override;
  void init() override;
  void initial_integrate(int vflag) override;
  void end_of_step() override;
  /// f_id[1..3]: edges [m]; [4..6]: normal stresses, compression positive [Pa]; [7]: density
  /// [kg/m3]; [8]: inertial number
  double compute_vector(int n) override;
  const Options& options() const override { return options_; }

 private:
  struct Axis {
    enum class Control { hold, rate, stress } control = Control::hold;
    // strain rate, compression positive [1/s], or normal stress, compression positive [Pa]
    double target = 0.0;
    double integral = 0.0;  // of the controller [1/s]
    double rate = 0.0;      // of the last step [1/s]
  };

  void measure();
  double next_rate(Axis& axis, double stress) const;
  void move_box();

  Options options_;
  std::array<Axis, 3> axes_;
  double rate_limit_, stiffness_, response_time_, ramp_time_;
  double elapsed_ = 0.0;
  std::array<double, 3> stress_{};
  double mass_ = 0.0, mean_diameter_ = 0.0, grain_density_ = 0.0;
};

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A LIGGGHTS instance with Furrow's styles inside a test, and bodies that a test moves as it
/// likes.

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <mpi.h>

#include "furrow/bodies/body.h"
#include "coupling/base/fix_coupled_system.h"
#include "lammps.h"

namespace furrow::test {

/// A surface whose nodes follow a function of time.
class PrescribedBody : public Body {
 public:
  using Motion = std::function<void(double time, Surface&)>;  ///< sets x and v
  PrescribedBody(Surface surface, Motion motion)
      : surface_(std::move(surface)), motion_(std::move(motion)) {}

  double stable_time_step() const override { return std::numeric_limits<double>::infinity(); }
  void advance(double dt) override {
    time_ += dt;
    motion_(time_, surface_);
  }
  Surface& surface() override { return surface_; }
  EnergyBudget energy_budget() const override { return {}; }
  void checkpoint(Checkpoint& state) override { state.value("time", time_); }

 private:
  Surface surface_;
  Motion motion_;
  double time_ = 0.0;
};

/// Square sheet of n x n cells, two triangles each, side length, in the plane z, normal up.
/// Diagonals alternate if asked.
Surface make_sheet(int n, double side, double z, bool alternate = false);

/// One run. Commands as in a script; screen output goes nowhere.
class Scene {
 public:
  Scene();
  ~Scene();

  void command(const std::string& text);
  void commands(const std::string& lines);
  /// Makes a body known as fix <id>.
  void add_body(const std::string& id, std::unique_ptr<Body> body);
  /// The body of a fix, of add_body() or of the script.
  Body& body(const std::string& id);
  /// Called at the end of every step.
  void at_end_of_step(std::function<void()> action);
  /// Called at the start of every step, before the bodies advance (place for moving grains by
  /// hand).
  void at_start_of_step(std::function<void()> action);

  LAMMPS_NS::LAMMPS& lammps() { return *lammps_; }
  coupling::FixCoupledSystem& system() { return coupling::FixCoupledSystem::of(*lammps_); }
  int rank() const;
  int ranks() const;
  double sum(double value) const;
  double max(double value) const;
  /// Sum of masses of all grains [kg].
  double grain_mass() const;
  /// Kinetic energy of all grains, rotation included [J].
  double grain_kinetic_energy() const;
  /// Momentum of all grains along z [N s].
  double upward_momentum() const;
  /// z of the highest point of a grain [m].
  double top_of_grains() const;

  /// Header of a granular scene in SI units: box corners, atom types, skin.
  void granular_box(const Vector3& lower, const Vector3& upper, double skin,
                    const std::string& boundary = "f f f");
  /// Hertz contact properties alike for all types.
  void contact_properties(double young, double poisson, double restitution, double friction);
  /// The contact model of grains, the step [s], and gravity [m/s^2] downwards.
  void grains_fall(const std::string& contact, double step, double gravity = 9.81);
  /// Flat walls for grains, each as "xplane -0.1". Their fixes are x1, x2, y1, y2 and z2: 1 below
  /// 0.
  void flat_walls(const std::string& contact, const std::vector<std::string>& planes);
  /// The surface of a body as fix skin, and its wall for grains as fix <wall>.
  void wall_of_body(const std::string& body, const std::string& contact, const std::string& wall);
  /// Spheres of 2500 kg/m3 at random places of a region; fix move moves them.
  /// @param amount "particles_in_region N" or "volumefraction_region SHARE"
  void pour(double radius, const std::string& region, const std::string& amount,
            const std::string& all_in = "yes");

  // For the fixes of a scene, which find it by its address in their line.
  std::unique_ptr<Body> hand_over_body(const std::string& id);
  void run_action(const std::string& id) { actions_.at(id)(); }

 private:
  void add_action(const std::string& style, std::function<void()> action);

  LAMMPS_NS::LAMMPS* lammps_;
  std::map<std::string, std::unique_ptr<Body>> waiting_;  // until their fix is made
  std::map<std::string, std::function<void()>> actions_;  // of each fix
};

}  // namespace furrow::test

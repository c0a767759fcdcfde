#pragma once
/// Continuum ground by the explicit material point method, for any law of the material library and any surface that presses on it.

#include <memory>
#include <vector>

#include "body/body.h"
#include "core/communicator.h"
#include "mpm/ground_parameters.h"
#include "mpm/ground_sheet.h"
#include "mpm/overburden.h"
#include "mpm/particles.h"
#include "mpm/partition.h"

namespace furrow {

/// All particles of one law.
struct GroundPhase {
  std::shared_ptr<const Material> law;
  Particles particles;
};

/// What is left behind of a moving ground: the surface where it was dropped.
struct RutPoint {
  double x, y;     ///< [m]
  double z;        ///< of the surface [m]
  double density;  ///< mean over the depth [kg/m^3]
};

/// One step from t_n to t_n+1 (double precision throughout; velocities at half steps, as LIGGGHTS's leapfrog has them):
///   particles -> grid, contact impulses -> grid, faces, grid -> particles (transfer.h), the law with H = dt C, x += dt v.
/// Particles are kept in the order of their cells. Each rank owns a slab of the ground (partition.h); every call is collective unless said
/// otherwise, and bodies that touch it are replicated.
class MpmGround : public Body {
 public:
  /// @param where names the ground in errors  @throws InputError
  MpmGround(const GroundParameters& parameters, const Communicator& ranks, const std::string& where = "continuum ground");

  double stable_time_step() const override;
  void advance(double dt) override;
  using Body::surface;
  /// The sheet of a ground that carries grains; otherwise without triangles, as others press on the particles.
  Surface& surface() override { return sheet_.surface(); }
  Balance balance() const override;
  std::vector<double> state() const override;
  void restore(const std::vector<double>& state) override;

  const GroundParameters& parameters() const { return parameters_; }
  const Grid& grid() const { return grid_; }
  const Faces& faces() const { return faces_; }
  const Communicator& ranks() const { return partition_.ranks(); }
  Vector3 face_impulse(FacePlace face) const;                  ///< [N s] given to the ground since the start
  double particle_count() const;                               ///< of all ranks
  const UpdateReport& last_report() const { return report_; }  ///< of this rank's particles in the last step

  // ---- for contacts: this rank's particles; not collective ------------------------------------------------------------------
  std::vector<GroundPhase>& phases() { return phases_; }
  const std::vector<GroundPhase>& phases() const { return phases_; }
  /// Changes whenever particles change their places in memory.
  unsigned long generation() const { return generation_; }
  double largest_speed() const { return largest_speed_; }  ///< [m/s] of this rank's particles
  /// A force on a particle during the next step, acting at the particle's position plus the lever [N, m].
  void push(std::size_t phase, std::size_t particle, const Vector3& force, const Vector3& lever);

  // ---- moving ground ---------------------------------------------------------------------------------------------------------
  /// The middle of the ground follows this x, cell by cell: ground is dropped behind and fresh ground added ahead.
  void follow(double x) { focus_ = x; }
  const std::vector<RutPoint>& rut() const { return rut_; }  ///< this rank's share of what was dropped
  double travelled() const;                                  ///< [m] of the grid since the start

 private:
  struct Push {
    std::size_t phase, particle;
    Vector3 force, lever;
  };
  void fill();
  void lay_sheet();
  void move_sheet();
  void add_column(int cell);
  void scatter(double dt);
  void gather(double dt);
  void move_window();
  void drop_behind();
  void sort();
  void migrate();
  double energy(std::size_t kind) const;  // of a field per reference volume, this rank's particles [J]
  double internal_energy() const;
  GridView local_view();
  [[noreturn]] void report_outside(const GroundPhase& phase) const;
  std::vector<double> fingerprint() const;

  GroundParameters parameters_;
  std::string where_;
  Grid grid_;
  std::vector<GroundLevel> levels_;
  std::vector<GroundPhase> phases_;
  Partition partition_;
  Faces faces_;
  const TransferKernels& kernels_;

  std::vector<Push> pushes_;
  std::vector<PointImpulse> impulses_;
  std::vector<double> gradient_;
  std::vector<double*> state_pointers_;
  UpdateReport report_;
  unsigned long generation_ = 0;
  double largest_speed_ = 0.0, drift_ = 0.0;  // [m/s]; [m] possible since the last sorting
  double next_id_ = 0.0;
  double focus_, start_;  // [m]
  int shifts_ = 0;        // of the window, in cells
  std::vector<RutPoint> rut_;
  GroundSheet sheet_;

  // this rank's share, since the start [J]
  double kinetic_ = 0.0, initial_ = 0.0, stress_work_ = 0.0, contact_work_ = 0.0, gravity_work_ = 0.0;
  double dropped_kinetic_ = 0.0, dropped_internal_ = 0.0, dropped_dissipated_ = 0.0;
};

}  // namespace furrow

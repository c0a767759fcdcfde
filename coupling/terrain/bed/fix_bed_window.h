// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix bed/window: renews the bed behind a body, so that a short periodic bed allows arbitrarily
/// long travel at constant cost. See fix_bed_window.md.

#include <cstdint>
#include <optional>
#include <vector>

#include "coupling/base/roles/fix_order.h"
#include "coupling/base/furrow_fix.h"
#include "coupling/terrain/fix_terrain_continuum.h"
#include "coupling/terrain/bed/remembered_bed.h"

namespace furrow::coupling {

class FixBedWindow : public FurrowFix, public SystemFollower {
 public:
  FixBedWindow(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static const Outputs<FixBedWindow>& outputs();

  std::string reason_to_follow() const override {
    return "slabs are renewed by where the body has come to";
  }
  int setmask() override;
  void init() override;
  void setup_pre_neighbor() override;
  void initial_integrate(int vflag) override;
  void pre_exchange() override;
  void pre_neighbor() override {}
  void setup(int vflag) override { post_force(vflag); }
  void post_force(int vflag) override;

 private:
  void check_slab() const;
  void check_terrain() const;
  void check_place_of_terrain() const;
  void checkpoint(Checkpoint& state) override;
  double middle_of_body() const { return body_.surface().x.row(0).mean(); }  // [m] along x
  std::int64_t slab_of(double x) const;  // 0 to slabs_-1, x anywhere
  std::int64_t slab_of_grain(std::size_t grain) const { return slab_of(bed_->position(grain)[0]); }
  bool is_frozen(int local_grain) const;
  double slab_end(std::int64_t slab) const;  // [m], of the x that keeps growing
  bool moved_on();
  void renew(std::int64_t slab);
  void take_out(std::int64_t slab, const std::vector<std::size_t>& fresh);
  bool overlaps(int local_grain, const std::vector<std::size_t>& grains) const;
  bool overlaps_new_surface(int local_grain) const;
  void put_in(const std::vector<std::size_t>& grains, std::optional<std::int64_t> rut);

  const Body& body_;
  double behind_;  // [m]
  std::int64_t slabs_;
  double slab_length_;                            // [m]
  const FixTerrainContinuum* terrain_ = nullptr;  // terrain that carries the bed, if any
  std::int64_t next_ = 0;                         // slab to be renewed
  std::int64_t renewed_ = 0;
  std::int64_t inserted_minus_removed_ = 0;  // grains of this rank
  bool due_ = false;

  std::optional<RememberedBed> bed_;  // from the first set-up on
  std::vector<std::size_t> frozen_;   // grains of the slab renewed last
  int first_frozen_tag_ = 0;
  int last_frozen_tag_ = -1;
};

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix bed/window: the bed behind a body is renewed, so that a periodic bed of few wheel lengths
/// serves a roll of any length. See fix_bed_window.md.

#include <optional>
#include <vector>

#include "coupling/base/fix_order.h"
#include "coupling/base/furrow_fix.h"
#include "coupling/terrain/remembered_bed.h"

namespace furrow::coupling {

class FixBedWindow : public FurrowFix, public FollowsSystem {
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
  void checkpoint(Checkpoint& state) override;
  double middle_of_body() const { return body_.surface().x.row(0).mean(); }  // [m] along x
  long slab_of(double x) const;  // 0 to slabs_-1, x anywhere
  long slab_of_grain(std::size_t grain) const { return slab_of(bed_->position(grain)[0]); }
  bool is_frozen(int local_grain) const;
  void renew(long slab);
  void take_out(long slab, const std::vector<std::size_t>& fresh);
  bool overlaps(int local_grain, const std::vector<std::size_t>& grains) const;
  void put_in(const std::vector<std::size_t>& grains, std::optional<long> rut);

  const Body& body_;
  double behind_;  // [m]
  long slabs_;
  double slab_length_;  // [m]
  long next_ = 0;       // slab to be renewed
  long renewed_ = 0;
  long inserted_minus_removed_ = 0;  // grains of this rank
  bool due_ = false;

  std::optional<RememberedBed> bed_;  // from the first set-up on
  std::vector<std::size_t> frozen_;   // grains of the slab renewed last
  int first_frozen_tag_ = 0;
  int last_frozen_tag_ = -1;
};

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix bed/window: the bed behind a body is renewed, so that a periodic bed of few wheel lengths
/// serves a roll of any length. See fix_bed_window.md.

#include <vector>

#include "bodies/body.h"
#include "coupling/base/uses_fix.h"
#include "coupling/output/effective_input.h"
#include "fix.h"

namespace furrow::coupling {

class FixBedWindow : public LAMMPS_NS::Fix, public HasOptions, public UsesFix {
 public:
  FixBedWindow(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();

  int setmask() override;
  void init() override;
  void setup_pre_neighbor() override;
  void initial_integrate(int vflag) override;
  void pre_exchange() override;
  void pre_neighbor() override {}
  void setup(int vflag) override { post_force(vflag); }
  void post_force(int vflag) override;
  /// f_id[1]: slabs renewed; [2]: grains now; [3]: grains put in less grains taken out since the
  /// start
  double compute_vector(int n) override;
  bool uses(LAMMPS_NS::Fix& other) const override;
  const Options& options() const override { return options_; }

 private:
  void remember_bed();
  void renew(long slab);
  long slab_of(double x) const;  // 0 to slabs_-1, x anywhere
  int slab_of_grain(std::size_t grain) const { return static_cast<int>(slab_of(packed(grain)[1])); }
  const double* packed(std::size_t grain) const { return &reference_[offset_[grain]]; }
  void take_out(long slab, const std::vector<std::size_t>& fresh);
  void put_in(const std::vector<std::size_t>& grains, int rut);

  Options options_;
  Body& body_;
  double behind_;
  long slabs_, next_ = 0, renewed_ = 0, inserted_minus_removed_ = 0;
  double slab_length_ = 0.0;
  bool due_ = false, remembered_ = false;

  // The undisturbed bed as AtomVec::pack_exchange writes it, all ranks' grains on every rank,
  // sorted by tag.
  std::vector<double> reference_;
  std::vector<std::size_t> offset_;          // of each grain in reference_
  std::vector<std::size_t> history_offset_;  // of its contact history, from its own beginning
  std::vector<int> current_tag_;             // of the latest copy of each grain
  std::vector<std::size_t> frozen_;          // grains of the slab renewed last
  int first_frozen_tag_ = 0, last_frozen_tag_ = -1;
  int largest_tag_ = 0;
};

}  // namespace furrow::coupling

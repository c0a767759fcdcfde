// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The base of every fix that makes a tyre: keys, refusals, outputs and state that tyres share.

#include "furrow/bodies/hub_parameters.h"
#include "coupling/base/fix_wheel_hub.h"
#include "furrow/tyre/tyre.h"

namespace furrow::coupling {

class FixTyre : public FixWheelHub {
 public:
  static const Outputs<FixTyre>& outputs();

  Tyre& tyre() { return static_cast<Tyre&>(body()); }
  void init() override;

 protected:
  FixTyre(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Schema& schema,
          const MakeHub& make_tyre);

  /// The tyre file with its effective values, a line for each.
  virtual std::string tyre_text() = 0;
  void checkpoint(Checkpoint& state) override;
};

// ---- for the schemas and constructors of such fixes
// ------------------------------------------------------

void declare_file_and_pressure(Schema& schema);
void declare_damping(Schema& schema);

/// Path of the tyre file.
std::string tyre_path(LAMMPS_NS::LAMMPS& lammps, const Options& options);
/// The pressure of the line, or else that of the file [Pa]. @throws InputError for one that no tyre
/// has
double read_pressure(const Options& options, double of_file);
/// @throws InputError for a half model beside its plane of symmetry, or an inertia that no rim with
/// beads of this radius [m] has
void check_rim(const Options& options, const HubParameters& hub, double bead_radius);
/// Inflates a tyre without a load until it rests. @throws InputError for a pressure at which it
/// does not
void inflate(const Options& options, Tyre& tyre);
/// @throws InputError for a damping that is faster than a step [s]
void check_damping(const Options& options, double stable_step);

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Report of a run: identity, audit and cost. The history file keeps it, the summary prints it.

#include <string>
#include <vector>

#include "furrow/core/types.h"
#include "furrow/io/results/style_record.h"
#include "furrow/io/files/version.h"

namespace furrow {

/// Origin of a run: its script, programs and settings. Written when it starts.
struct RunInfo {
  std::string title;  ///< the scene: "rigid wheel on sand"
  std::string version = furrow::version();
  std::string script;  ///< the input script as the user named it
  /// every style with all its values, defaults included: as text with the script, and as records
  std::string effective_input;
  std::vector<StyleRecord> styles;
  std::string started;  ///< ISO 8601, UTC; empty: now
  int ranks = 1;
};

/// One side of the energy audit: a named work or energy.
struct EnergyTerm {
  std::string name;    ///< "contact work on the wheel"
  double value = 0.0;  ///< [J]
};

/// Conservation, as the run measured it.
struct Audit {
  /// [J] the terms of the energy balance, each with its sign in it
  std::vector<EnergyTerm> energies;
  double energy_residual = 0.0;  ///< [J] difference of the sums of the terms
  /// [J] the largest of the terms: the residual is judged against it
  double energy_scale = 0.0;
  /// [N] largest |sum of nodal forces + sum of grain wall forces| of any step
  double force_imbalance = 0.0;
  double force_scale = 0.0;       ///< [N] largest sum of |contact force| of any step
  double moment_imbalance = 0.0;  ///< [N m] largest imbalance of moments
  double moment_scale = 0.0;      ///< [N m]

  /// Sets the terms, their residual and their scale.
  void set_energies(std::vector<EnergyTerm> terms, double residual);
};

/// Cost of the process that brought a run to its end, counted from its restart if there was one.
/// Zero where not measured.
struct Cost {
  double wall_time = 0.0;       ///< [s] of the stepping
  double simulated_time = 0.0;  ///< [s]
  long steps = 0;
  long grains = 0;
  int ranks = 1;
  double memory = 0.0;  ///< [byte] peak resident size, all ranks together

  double particle_steps_per_second() const {
    return wall_time > 0.0 ? double(steps) * double(grains) / wall_time : 0.0;
  }
  double simulated_per_wall_second() const {
    return wall_time > 0.0 ? simulated_time / wall_time : 0.0;
  }
};

/// Part of the report that the end of a run adds.
struct RunClosing {
  Audit audit;
  Cost cost;
  std::vector<std::string> warnings;  ///< whole sentences; the summary repeats them
};

/// Peak resident memory of this process [byte]; 0 if the system does not report it. Sum it over the
/// ranks for Cost::memory.
double peak_memory();

}  // namespace furrow

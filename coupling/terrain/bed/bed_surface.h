// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The surface at which a bed of grains is levelled: its depth, and a relief above it.

#include <string>
#include <vector>

#include "furrow/core/options/options.h"
#include "furrow/core/types.h"
#include "furrow/geometry/ground_relief.h"
#include "lammps.h"

namespace furrow::coupling {

class BedSurface {
 public:
  /// Surface of a line `bed`. A relief needs the parameters length, width and diameter.
  /// @param folder from which the relative path of a heightmap is found
  /// @throws InputError for a relief that the bed cannot have
  BedSurface(const Options& options, const std::string& folder);

  bool flat() const { return relief_.flat(); }
  /// z above the floor at a place, or at the nearest one of the bed [m]
  double height(double x, double y) const;
  double lowest() const { return lowest_; }    ///< [m]
  double highest() const { return highest_; }  ///< [m]
  double mean() const { return mean_; }        ///< [m]
  /// Checksum of the relief's heightmap, equal for equal maps; empty without one.
  std::string map_checksum() const { return relief_.map_checksum(); }

  /// Features of the relief that grains of this size do not show, a sentence each.
  std::vector<std::string> warnings() const;
  /// Checks that the relief goes on behind its end in a box that is periodic. @throws InputError
  void check_period(const LAMMPS_NS::LAMMPS& lammps) const;
  /// A settled bed has slumped where its grains lie off the surface by more than a diameter.
  /// @param rms deviation of the grains' tops [m] @returns a sentence; empty for a bed that has not
  std::string settled_warning(double rms) const;

 private:
  void measure(const std::string& where);
  double fine_share() const;

  GroundRelief relief_;
  double depth_ = 0.0, lowest_ = 0.0, highest_ = 0.0, mean_ = 0.0;  // [m]
  Vector2 half_ = Vector2::Zero();                                  // of length and width [m]
  double diameter_ = 0.0;                                           // mean, of the grains [m]
};

/// Removes the grains whose centre is above the surface. Collective.
void remove_surplus(LAMMPS_NS::LAMMPS& lammps, const BedSurface& surface);

}  // namespace furrow::coupling

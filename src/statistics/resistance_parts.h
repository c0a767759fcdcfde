// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Parts of the resistance: the energies of a run over a window, per metre of travel
/// (theory: resistance, eq. 1).

#include <string>
#include <vector>

#include "furrow/statistics/steady_state.h"

namespace furrow {

/// Part of the resistance: name and force.
struct ResistancePart {
  std::string name;
  double force = 0.0;  ///< [N] energy over travel
};

/// whole = sum of parts + unexplained. The whole is the work of axle and load per travel: torque,
/// pull, slope and sinking. For a towed wheel on level ground it is the towing force.
struct ResistanceParts {
  double whole = 0.0;                 ///< [N]
  std::vector<ResistancePart> parts;  ///< parts that occur in the scene
  double unexplained = 0.0;           ///< [N]
  /// how the wheel gave the grains their energy, if their parts are divided by place
  std::vector<ResistancePart> given_to_grains;

  bool known() const { return !parts.empty(); }
};

/// Parts of one wheel. The work on a continuum is divided only if nothing else presses on it;
/// otherwise it is one part. The work on grains is divided by place (below the track, ahead and
/// aside) if fix grain/work counted all of it, otherwise by vertical and horizontal forces.
/// @return without parts for a history without the channels of rig/wheel_rig_outputs.cpp, or a
/// window without travel
ResistanceParts resistance_parts(const History& history, const Window& window);

/// Parts of the wheels of one vehicle, over the travel of the first. A continuum that they share is
/// divided for all of them together.
/// @param windows of the histories, of the same time
ResistanceParts resistance_parts(const std::vector<History>& histories,
                                 const std::vector<Window>& windows);

}  // namespace furrow

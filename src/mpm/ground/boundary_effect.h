// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Effect of the sides and the base of ground on the results of a body on it: fits to the runs of
/// the study inputs/validation/ground_size, which a test compares with its stored rows.

#include "furrow/material/material.h"

namespace furrow {

/// Kinds of ground that sides and base affect differently. Snow compacts in place, by more than a
/// tenth under 20 kPa without lateral strain. Sand flows, and its strength grows with the pressure.
/// Clay flows at a strength that does not grow. Elastic ground counts as clay.
enum class GroundKind { sand, clay, snow };
GroundKind ground_kind(const Material& material);
const char* name_of(GroundKind kind);

enum class PressedBy { wheel, plate };

/// Change by an edge at the distance x, in widths of the body: a exp(-x/c).
struct BoundaryEffect {
  double amplitude;  ///< a, with its sign
  double decay;      ///< c
  double at(double x) const;
  /// x beyond which the change is smaller
  double distance(double change) const;
};

/// Effects by a distance x: of sides, from the side of the body to that of the ground; of the base,
/// from the undisturbed surface.
struct BoundaryEffects {
  BoundaryEffect response;  ///< share of the hub drop of a wheel, or of the force on a plate
  BoundaryEffect traction;  ///< of the net traction coefficient; none for a plate
  /// x beyond which a response changes by less than 2 % and a net traction coefficient by less
  /// than 0.01
  double enough() const;
};
BoundaryEffects effects_of_sides(GroundKind kind, PressedBy body);
BoundaryEffects effects_of_base(GroundKind kind, PressedBy body);

}  // namespace furrow

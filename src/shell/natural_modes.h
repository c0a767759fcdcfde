// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Natural frequencies and modes of a shell structure: small undamped vibrations about its loaded
/// equilibrium, K u = omega^2 M u.

#include <vector>

#include "furrow/shell/tangent_stiffness.h"

namespace furrow {

struct NaturalModes {
  VectorX frequency;            ///< [Hz] ascending
  std::vector<Matrix3X> shape;  ///< displacement of each node; the largest component of all is 1
  double asymmetry = 0.0;       ///< of the stiffness, see tangent_stiffness.h
};

/// The lowest modes, by Lanczos' method on the inverse (Spectra) of M^-1/2 K M^-1/2. The number of
/// frequencies below the highest one found is counted by the signs of a factorisation (Sylvester's
/// law of inertia), so that none is missed.
///
/// The rotary inertia of nodes is raised (shell4.h), which lowers frequencies of waves not much
/// longer than an element.
/// @param structure at rest, held such that it cannot move as a rigid body
/// @param count of modes, 1 to one less than the free components
/// @throws InputError for a count out of range; StateError when the state is not a stable
/// equilibrium or the solver fails
NaturalModes natural_modes(RelaxingStructure& structure, const NodeNeighbours& neighbours,
                           int count);

}  // namespace furrow

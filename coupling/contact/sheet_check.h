// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Bodies and terrain in one wall of grains do not feel one another.

#include <string>
#include <vector>

#include "bodies/body.h"

namespace furrow::coupling {

/// Has a body come through the grains to the sheet of the terrain that carries them? Surfaces are
/// replicated, so all ranks agree.
/// @param bodies  of the meshes of one wall
/// @param where   names the wall
/// @throws StateError when a node of a sheet lies inside of another body
void refuse_bodies_at_sheet(const std::vector<const Body*>& bodies, const std::string& where);

}  // namespace furrow::coupling

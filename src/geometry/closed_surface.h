// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Check that a surface is closed and oriented, as the boundary of a solid.

#include <string>

#include "furrow/geometry/surface.h"

namespace furrow {

/// Fault of an open surface; empty when every edge belongs to two triangles that run through it in
/// opposite directions. It names an edge that does not: "the edge of nodes 3 and 7 belongs to one
/// triangle: the surface is open there".
std::string closedness_problem(const Surface& surface);

/// Checks a body whose volume or inside has a meaning. @throws StateError with the problem, if
/// there is one
void check_closed(const Surface& surface, const std::string& body);

}  // namespace furrow

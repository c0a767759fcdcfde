// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Natural modes of a tyre as files.
///
///   <name>_modes.csv   a line a mode: frequency, waves around, where the motion goes
///   <name>_modes.vtp   for ParaView: the tread with one vector field a mode ("Warp By Vector")
///   <name>_modes.h5    for furrow-post: /x (nodes, 3) [m], /triangles, /mode_<nn> (nodes, 3),
///                      each with the attributes frequency [Hz], waves, radial, circumferential,
///                      axial; / has title, pressure [Pa], load [N]

#include <string>

#include "furrow/tyre/tyre.h"

namespace furrow {

/// @param title of the figure; @param load [N] that the tyre stands under; 0: it stands on nothing
/// @throws Error naming the file
void write_modes(const std::string& name, const Tyre& tyre, const NaturalModes& modes,
                 const std::string& title, double load);

}  // namespace furrow

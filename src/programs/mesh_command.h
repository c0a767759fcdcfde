// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// furrow-tyre mesh: reads the mesh of a wheel, repairs it and prints the line of a script.

namespace furrow {

/// @return the status that ends the program
int run_mesh_command(int argc, char** argv);

}  // namespace furrow

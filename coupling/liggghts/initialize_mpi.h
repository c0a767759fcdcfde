// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace furrow::coupling {

/// MPI_Init(). A process that no launcher started is the only rank. Open MPI then leaves out its
/// daemon and its networks, which takes 0.1 s in place of 0.5 s. Variables OMPI_MCA_* of the user
/// win.
/// @param argc, argv as MPI_Init() takes them; may be null
void initialize_mpi(int* argc, char*** argv);

}  // namespace furrow::coupling

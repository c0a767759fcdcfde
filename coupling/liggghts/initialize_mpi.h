// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace furrow::coupling {

/// MPI_Init(). A process that no launcher started is the only rank. For it Open MPI leaves out its
/// daemon, its folder of files, its networks, its algorithms for many ranks and its search for
/// devices, and starts five times as fast. Variables OMPI_MCA_* and HWLOC_* that the user has set
/// hold.
/// @param argc, argv as MPI_Init() takes them; may be null
void initialize_mpi(int* argc, char*** argv);

}  // namespace furrow::coupling

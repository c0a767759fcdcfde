// SPDX-License-Identifier: GPL-2.0-or-later
// furrow: LIGGGHTS with the fix styles of this folder. Same command line, same scripts: furrow -in
// script.

#include <csignal>

#include <mpi.h>

#include "input.h"
#include "lammps.h"
#include "signal_handling.h"

int main(int argc, char** argv) {
  // As liggghts does: an interrupt ends the run at the next step and lets fixes write what they
  // have.
  struct sigaction interrupt = {}, checkpoint = {};
  interrupt.sa_handler = LAMMPS_NS::SignalHandler::int_handler;
  checkpoint.sa_handler = LAMMPS_NS::SignalHandler::usr1_handler;
  sigaction(SIGINT, &interrupt, nullptr);
  sigaction(SIGTERM, &interrupt, nullptr);
  sigaction(SIGUSR1, &checkpoint, nullptr);

  MPI_Init(&argc, &argv);
  auto* lammps = new LAMMPS_NS::LAMMPS(argc, argv, MPI_COMM_WORLD);
  lammps->input->file();
  delete lammps;
  MPI_Finalize();
}

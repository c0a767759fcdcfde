// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/signals.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include "coupling/liggghts/script.h"
#include "signal_handling.h"
#include "update.h"

namespace furrow::coupling {

namespace {

using namespace LAMMPS_NS;

// What a signal handler may touch.
volatile std::sig_atomic_t stop_wanted = 0;  // the signal
volatile std::sig_atomic_t checkpoint_wanted = 0;
volatile std::sig_atomic_t confirms = 1;

int agreed = 0;
bool stop_with_checkpoint = false;

const char* name_of_signal(int signal) {
  return signal == SIGINT ? "SIGINT" : signal == SIGHUP ? "SIGHUP" : "SIGTERM";
}

/// Nothing can be done about a message that cannot be written.
void say(std::string_view text) {
  if (write(STDERR_FILENO, text.data(), text.size()) < 0) return;
}

void stop(int signal) {
  if (stop_wanted) {
    if (confirms) say("\nA second signal: the run ends at once.\n");
    _exit(128 + signal);
  }
  stop_wanted = signal;
  if (confirms)
    say("\nThe run stops at the next step, with a checkpoint; a second signal ends it at once.\n");
}

void want_checkpoint(int) { checkpoint_wanted = 1; }

}  // namespace

void handle_signals() {
  struct sigaction action = {};
  action.sa_handler = stop;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction before = {};
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // nohup ignores it
  action.sa_handler = want_checkpoint;
  sigaction(SIGUSR1, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // results are in files: whoever reads the screen may leave
}

void confirm_signals(bool confirm) { confirms = confirm; }

void agree_on_signals(const LAMMPS& lammps) {
  int wanted[2] = {stop_wanted, checkpoint_wanted};
  MPI_Allreduce(MPI_IN_PLACE, wanted, 2, MPI_INT, MPI_MAX, lammps.world);
  const bool may_write = SignalHandler::enable_restart_writing;
  if (wanted[1]) {
    checkpoint_wanted = 0;
    SignalHandler::request_write_restart = may_write;
  }
  if (!wanted[0] || agreed) return;
  agreed = wanted[0];
  stop_with_checkpoint = may_write;
  SignalHandler::request_quit = true;
  SignalHandler::request_write_restart = may_write;
}

int agreed_signal() { return agreed; }
int failure_status() { return agreed ? 128 + agreed : EXIT_FAILURE; }

NoCheckpointOnSignal::NoCheckpointOnSignal() : before_(SignalHandler::enable_restart_writing) {
  SignalHandler::enable_restart_writing = false;
}
NoCheckpointOnSignal::~NoCheckpointOnSignal() { SignalHandler::enable_restart_writing = before_; }

void report_stop(LAMMPS& lammps) {
  const bigint step = lammps.update->ntimestep;
  const std::string file = fmt::format("restart_forced_liggghts_{}.data", step);  // of LIGGGHTS
  warn(lammps, stop_with_checkpoint
                   ? fmt::format("{} stopped the run after step {}; to continue it, write "
                                 "'read_restart {}' in the place of what makes the box, or "
                                 "'from {}' in the line 'bed'",
                                 name_of_signal(agreed), step, file, file)
                   : fmt::format("{} stopped the run after step {}, without a checkpoint",
                                 name_of_signal(agreed), step));
}

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/errors/signals.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include "atom.h"
#include "comm.h"
#include "coupling/liggghts/styles/script.h"
#include "output.h"
#include "signal_handling.h"
#include "update.h"

namespace furrow::coupling {

namespace {

using namespace LAMMPS_NS;

// Flags that a signal handler may touch.
volatile std::sig_atomic_t stop_wanted = 0;  // the signal
volatile std::sig_atomic_t checkpoint_wanted = 0;
volatile std::sig_atomic_t confirms = 1;
// True during a command bed, which takes minutes without a step, and after the first run.
volatile std::sig_atomic_t makes_bed = 0, has_run = 0;

using Clock = std::chrono::steady_clock;

// Time [ms] to wait for a step that makes neighbour lists. mpirun that passes a signal on to all
// its ranks kills them a second later.
constexpr int patience = 5000, patience_under_mpirun = 500;
constexpr int patience_between_commands = 800;

int agreed = 0;
bool stop_with_checkpoint = false, lists_for_checkpoint = false;
std::optional<Clock::time_point> waits_since;

/// Time since the wait began [ms].
int time_waited() {
  if (!waits_since) waits_since = Clock::now();
  const auto waited =
      std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - *waits_since);
  return static_cast<int>(waited.count());
}

constexpr char off_the_lists[] =
    ". No neighbour lists were due for so long that they were made for it: the run will differ "
    "from "
    "one without a break, at first by the last digits of forces between grains";

const char* name_of_signal(int signal) {
  return signal == SIGINT ? "SIGINT" : signal == SIGHUP ? "SIGHUP" : "SIGTERM";
}

/// Nothing can be done about a message that cannot be written.
void say(std::string_view text) {
  if (write(STDERR_FILENO, text.data(), text.size()) < 0) return;
}

void stop(int signal) {
  if (makes_bed || !has_run) {
    if (confirms)
      say(makes_bed
              ? "\nERROR: command bed was interrupted while it made the bed, which is not kept; "
                "start the script again\n"
              : "\nThe script was interrupted before its first run; start it again\n");
    _exit(128 + signal);
  }
  if (stop_wanted) {
    if (confirms) say("\nA second signal: the run ends at once.\n");
    _exit(128 + signal);
  }
  stop_wanted = signal;
  if (confirms)
    say("\nThe run stops within seconds, with a checkpoint; a second signal ends it at once.\n");
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

bool follow_signals(const LAMMPS& lammps, bool lists) {
  const bool wanted_here = stop_wanted || checkpoint_wanted;
  int wanted[4] = {stop_wanted, checkpoint_wanted, !wanted_here, wanted_here ? time_waited() : 0};
  MPI_Allreduce(MPI_IN_PLACE, wanted, 4, MPI_INT, MPI_MAX, lammps.world);
  const auto [stops, writes, not_to_all, waited] = wanted;
  if ((!stops && !writes) || agreed) return false;
  const bool by_mpirun = lammps.comm->nprocs > 1 && !not_to_all;
  const bool out_of_patience = waited >= (by_mpirun ? patience_under_mpirun : patience);
  const bool may_write = SignalHandler::enable_restart_writing;
  const bool has_lists = lists || lammps.atom->natoms == 0;
  const bool last_step = lammps.update->ntimestep == lammps.update->laststep;
  if (may_write && !has_lists && !last_step && !out_of_patience) return false;

  agreed = stops;
  stop_with_checkpoint = may_write;
  lists_for_checkpoint = may_write && !has_lists;
  checkpoint_wanted = 0;
  waits_since.reset();
  SignalHandler::request_quit = stops != 0;
  SignalHandler::request_write_restart = may_write;
  return lammps.output->restart_requested(lammps.update->ntimestep);
}

bool stop_between_commands(const LAMMPS& lammps) {
  if (agreed) return false;
  int state[2] = {stop_wanted, stop_wanted ? time_waited() : 0};
  MPI_Allreduce(MPI_IN_PLACE, state, 2, MPI_INT, MPI_MAX, lammps.world);
  if (state[1] < patience_between_commands) return false;
  agreed = state[0];
  SignalHandler::request_quit = 1;
  return true;
}

int agreed_signal() { return agreed; }
int failure_status() { return agreed ? 128 + agreed : EXIT_FAILURE; }

bool run_can_be_continued() { return SignalHandler::enable_restart_writing; }

NoCheckpointOnSignal::NoCheckpointOnSignal() : before_(SignalHandler::enable_restart_writing) {
  SignalHandler::enable_restart_writing = false;
  makes_bed = 1;
}
NoCheckpointOnSignal::~NoCheckpointOnSignal() {
  SignalHandler::enable_restart_writing = before_;
  makes_bed = 0;
}

void note_step() {
  if (!makes_bed) has_run = 1;
}

void report_stop(LAMMPS& lammps) {
  const bigint step = lammps.update->ntimestep;
  const std::string file = fmt::format("restart_forced_liggghts_{}.data", step);  // of LIGGGHTS
  warn(lammps, stop_with_checkpoint
                   ? fmt::format("{} stopped the run after step {}; to continue it, write "
                                 "'read_restart {}' in the place of what makes the box, or "
                                 "'from {}' in the line 'bed'{}",
                                 name_of_signal(agreed), step, file, file,
                                 lists_for_checkpoint ? off_the_lists : "")
                   : fmt::format("{} stopped the run after step {}, without a checkpoint",
                                 name_of_signal(agreed), step));
}

}  // namespace furrow::coupling

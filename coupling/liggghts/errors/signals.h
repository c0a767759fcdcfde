// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// SIGINT, SIGTERM and SIGHUP end a run with a checkpoint; SIGUSR1 asks for a checkpoint. LIGGGHTS
/// has each rank act when its own signal comes, within a step, and makes neighbour lists for it;
/// here all ranks agree at one place of one step, which makes its lists anyway.
/// See restart/command_read_restart.md.

#include "lammps.h"

namespace furrow::coupling {

/// Handles these signals. A second of them ends the process at once.
void handle_signals();
/// Sets this process to report at once that a signal has come, or not.
void confirm_signals(bool confirm);

/// Follows signals at the one place of a step where it is decided whether neighbour lists are made:
/// if any rank has had a signal, all ranks follow it in this step, or wait for one that makes
/// lists, so that a continued run makes them at the same steps as one without a break. Collective.
/// @param lists are made in this step, whatever signals say
/// @return whether a checkpoint is written in this step, which takes new lists
bool follow_signals(const LAMMPS_NS::LAMMPS& lammps, bool lists);

/// Checks for a signal before each command: a script that loops without a run ends a second after
/// its signal. If its next run begins within that second, the script ends there, with a checkpoint.
/// Collective.
/// @return whether the command is left out
bool stop_between_commands(const LAMMPS_NS::LAMMPS& lammps);

/// A run of the scene has begun: from here on a signal waits for a checkpoint.
void note_step();

/// The signal that all ranks have agreed to end on; 0: none.
int agreed_signal();
/// Exit status of a run that stopped early: 128 and the signal, as shells have it, or 1 for an
/// error.
int failure_status();

/// True if a run is one of the scene. False while a bed is prepared.
bool run_can_be_continued();

/// While it lives, a signal ends the process at once: there is nothing to continue. A single
/// command of LIGGGHTS may fill a bed for minutes without a step.
class NoCheckpointOnSignal {
 public:
  NoCheckpointOnSignal();
  ~NoCheckpointOnSignal();
  NoCheckpointOnSignal(const NoCheckpointOnSignal&) = delete;
  NoCheckpointOnSignal& operator=(const NoCheckpointOnSignal&) = delete;

 private:
  bool before_;
};

/// Reports a stop by such a signal, after the script, on rank 0: the step, and how to continue.
void report_stop(LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling

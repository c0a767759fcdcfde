// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The machine that this process runs on.

namespace furrow {

/// Memory that a number of processes, this one among them, may use together on this machine
/// [bytes]: all of it, or what a control group (container, batch job) or limits of the shell leave.
double usable_memory(int processes);

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The process of another program that runs scripts: MPI, and what copies of this library share.

#include <string>

namespace furrow::coupling {

/// Starts MPI unless the process has. @return whether it did now. @throws Error after MPI has ended
bool start_mpi();

/// A text for all copies of this library in the process, in its environment. A child inherits the
/// environment, so the text names the process. @return empty if this process has set none
std::string shared_text(const char* variable);
void share_text(const char* variable, const std::string& text);

}  // namespace furrow::coupling

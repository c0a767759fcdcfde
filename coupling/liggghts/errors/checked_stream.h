// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Files that LIGGGHTS opens, writes and closes before anybody can look at them: dumps with a file
/// for each step.

#include <cstdio>
#include <string>

namespace furrow::coupling {

/// A stream that writes to another, which it closes when it is closed, and keeps in mind what did
/// not arrive there; the stream itself if there is no memory for that. @param name for the error
FILE* checked_stream(FILE* stream, const std::string& name);

/// Failed writes since the last call, on this rank: name and reason; empty if there was none.
std::string take_stream_failure();

}  // namespace furrow::coupling

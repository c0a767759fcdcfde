// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Groups that the end of a run adds to its results file: /audit, /cost and /warnings of
/// history_file.h.

#include "furrow/io/results/run_report.h"

namespace furrow {

class Hdf5File;

/// Writes the closing of a run, in the place of an earlier one. @throws Error
void write_closing(Hdf5File& file, const RunClosing& closing);
/// @throws Error when the run did not come to its end
RunClosing read_closing(const Hdf5File& file);

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// summary.txt for a person and summary.json for a program: what a run found, how sure it is, what
/// it cost.

#include <map>
#include <string>
#include <vector>

#include "furrow/io/results/run_report.h"
#include "furrow/statistics/passes.h"
#include "furrow/statistics/vehicle.h"

namespace furrow {

/// Content of a summary. The closing is missing if the run did not reach its end.
struct Summary {
  RunInfo info;
  Resistance resistance;  ///< of the first pass where there are several
  /// results of each pass of several in one rut; empty for a single one
  std::vector<Resistance> passes;
  /// meaning of the values that are means of a channel, by name
  std::map<std::string, std::string> definitions;
  /// reason why there is no resistance ("the history ends before the cruise"); empty if there is
  std::string trouble;
  RunClosing closing;
  bool closed = false;
};

/// Reads history.h5 of a results folder and evaluates it. A history that is too short is no error:
/// the summary reports it.
/// @throws Error when the file is missing or cannot be read
Summary summarise(const std::string& folder, const ResistanceOptions& options = {});

/// Verdict of at most 91 characters: the value that the run was made for and the hub drop, with
/// their errors over time, and whether they are steady. The summary's line "Verdict: ..." has at
/// most 100.
std::string verdict_of(const Summary& summary);

/// Two lines: the excluded errors, and the command that adds them.
std::string error_note(const std::string& folder);

std::string summary_text(const Summary& summary);
std::string summary_json(const Summary& summary);

/// The wheels of one vehicle, from the results folder of each. @throws Error
std::string vehicle_text(const std::vector<std::string>& folders,
                         const ResistanceOptions& options = {});

/// Writes summary.txt and summary.json into the folder, each in one step. @throws Error
void write_summary(const std::string& folder, const Summary& summary);

}  // namespace furrow

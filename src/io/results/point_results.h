// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Results folder of furrow-point run. point.csv has every channel at every step.
///
/// point.h5 has the same channels as /point/<channel>, with unit and meaning. The group /point has
/// the law and the path. /yield_surface/<n> has p and q of the yield surface after a segment, which
/// its attribute names.
///
/// material.yaml and run.yaml are the effective input: `furrow-point run run.yaml` repeats the run.

#include <string>

#include "furrow/io/inputs/point_file.h"
#include "furrow/material/point/point_driver.h"

namespace furrow {

struct MeasuredColumn;

/// Writes all files of a run into the folder, which is made. @throws Error naming the file
void write_point_run(const std::string& folder, const PointRun& run, const Material& material,
                     const PointHistory& history);

/// Report of a run: density, p, q, branches, limits met, cost and the error of the steps.
/// @param error  null when the path with halved steps could not be followed
std::string run_report(const PointRun& run, const Material& material, const PointHistory& history,
                       const StepError* error);

/// Title, material, parameters and curves of a fit on one line of JSON, for `furrow-point curves`;
/// an infinite bound and an empty cell are null.
std::string fit_description(const PointFit& fit);
/// Columns of a table as one line of JSON; null: an empty cell.
std::string measured_description(const std::vector<MeasuredColumn>& columns);
/// Values of every channel on one line of JSON, for `furrow-point channels`; NaN is null.
std::string channel_values(const Material& material, const PointHistory& history);
/// The material file with fitted values, as a text of JSON.
std::string fitted_material(const PointFit& fit, const MaterialSections& sections);

}  // namespace furrow

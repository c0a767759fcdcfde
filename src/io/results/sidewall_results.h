// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Results folder of furrow-sidewall.
///
///   deflection.csv, lateral.csv, rotation.csv
///                 forces and stiffness, solved and looked up, along each motion of the tread edge
///   sidewall.h5   the same as /<curve>/<column>; /profiles/<n>/A, R with the attribute deflection;
///   / has title, pressure tyre.yaml     the effective tyre file

#include <string>

#include "furrow/tyre/sidewall/sidewall_survey.h"

namespace furrow {

/// @throws Error naming the file
void write_sidewall_survey(const std::string& folder, const SidewallSurvey& survey);

/// Geometry, forces, stiffness, the table's accuracy, and a column of forces solved and looked up.
std::string sidewall_report(const SidewallSurvey& survey);

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Files of furrow-point: a path to drive (inputs/points/*.yaml), or curves to fit.
///
///   title: Drained triaxial test on McCormick Ranch sand        material:
///   ../materials/mccormick_sand.yaml path: { type: triaxial, confinement: 0.25e6, axial_strain:
///   [0.1], steps: 200 }
///
/// A general path has `type: table` and `rows: [ {strain_zz: -0.1, stress_xx: -1e5}, ... ]`. A fit
/// has, instead of `path`,
///   parameters: [ {name: law.d, lower: 1e3, upper: 1e5}, ... ]
///   curves:
///     - title: oedometer
///       data: ../validation/snow_oedometer/reference.csv
///       path: { type: confined }
///       drive: { stress: sigma1_Pa }       # the path's list of targets, from this column
///       compare: { density: rho_kgm3 }     # a channel of the point with this column
///       scale: log
///       deviation: 0.03

#include <string>
#include <vector>

#include "io/material_file.h"
#include "material/point/point_fit.h"
#include "material/point/point_path.h"

namespace furrow {

struct PointRun {
  std::string title;
  MaterialFile material;
  PointPath path;
  std::string path_text;  ///< the effective path section, which reads back as the same path
};

struct PointFit {
  std::string title;
  MaterialFile material;
  MaterialSections sections;  ///< of the material, with the keys of all parameters
  std::vector<FitParameter> parameters;
  std::vector<FitCurve> curves;
};

/// @throws InputError naming file, line and key
PointRun read_point_run(const std::string& path);
/// @throws InputError naming file, line and key
PointFit read_point_fit(const std::string& path);

/// The material with these values of the parameters. @throws InputError for another number of them
MaterialSections sections_with(const PointFit& fit, const std::vector<std::string>& values);

/// The keys of all path types, and of a fit, for `furrow-point paths`.
std::string path_tables();

}  // namespace furrow

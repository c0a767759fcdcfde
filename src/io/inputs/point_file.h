// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Files of furrow-point: a path to drive (inputs/points/*.yaml), or curves to fit
/// (inputs/points/fit_*.yaml). programs/furrow_point.md has their keys and an example of each.

#include <string>
#include <vector>

#include "furrow/io/inputs/material_file.h"
#include "furrow/material/point/point_fit.h"
#include "furrow/material/point/point_path.h"

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
  MaterialSections sections;  ///< of the material, with the keys of all parameters and samples
  std::vector<FitParameter> parameters;
  std::vector<FitCurve> curves;
};

/// @throws InputError naming file, line and key
PointRun read_point_run(const std::string& path);
/// @throws InputError naming file, line and key
PointFit read_point_fit(const std::string& path);

/// The material with these values of the parameters. @throws InputError for another number of them
MaterialSections sections_with(const PointFit& fit, const std::vector<std::string>& values);

/// All curves of a material, point by point. @throws StateError when a path cannot be followed
std::vector<double> curves_of(const PointFit& fit, const MaterialSections& sections);

/// The keys of all path types, and of a fit, for `furrow-point paths`.
std::string path_tables();

}  // namespace furrow

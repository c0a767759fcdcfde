// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Role of a style whose options the script gives.

#include <string>

#include "furrow/core/options/options.h"
#include "fix.h"

namespace furrow::coupling {

class ConfiguredStyle {
 public:
  virtual ~ConfiguredStyle() = default;
  virtual const Options& options() const = 0;
};

/// The style that the script wrote: LIGGGHTS knows a mesh/body as mesh/surface.
inline std::string style_of(const LAMMPS_NS::Fix& fix) {
  const auto* style = dynamic_cast<const ConfiguredStyle*>(&fix);
  return style ? style->options().subject().substr(std::string("fix ").size()) : fix.style;
}

/// Name for errors and warnings: "fix wheel/rigid 'wheel'".
inline std::string name_of(const LAMMPS_NS::Fix& fix) {
  return "fix " + style_of(fix) + " '" + fix.id + "'";
}

}  // namespace furrow::coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A style that can say which options it was given.

#include <string>

#include "furrow/core/options/options.h"
#include "fix.h"

namespace furrow::coupling {

class HasOptions {
 public:
  virtual ~HasOptions() = default;
  virtual const Options& options() const = 0;
};

/// The style that the script wrote: LIGGGHTS knows a mesh/body as mesh/surface.
inline std::string style_of(const LAMMPS_NS::Fix& fix) {
  const auto* described = dynamic_cast<const HasOptions*>(&fix);
  return described ? described->options().subject().substr(std::string("fix ").size()) : fix.style;
}

/// Name for errors and warnings: "fix wheel/rigid 'wheel'".
inline std::string name_of(const LAMMPS_NS::Fix& fix) {
  return "fix " + style_of(fix) + " '" + fix.id + "'";
}

}  // namespace furrow::coupling

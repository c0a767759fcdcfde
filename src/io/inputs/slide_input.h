// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The slide surface of continuum ground from the keys of a script line.

#include <optional>

#include "furrow/core/options/options.h"
#include "furrow/mpm/discontinuities/slide_surface.h"

namespace furrow {

void declare_slide_surface(Schema& schema);
/// Slide surface from the options of a schema that declares it and `cell`. @throws InputError
std::optional<SlideSurface> read_slide_surface(const Options& options);

}  // namespace furrow

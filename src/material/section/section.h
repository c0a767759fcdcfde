// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Section of a yield surface by a plane of constant p: how the strength depends on the kind of
/// strain. Declared options and queries; the update is in deviatoric_return.h.
///
///   t = q g(c),  c = cos(3 theta) = (r/q)^3,  r^3 = (27/2) det s      (theory: laws, eq. 11)
///
/// c is -1 in triaxial compression, where g = 1, and 1 in extension, where g = 1/K.
///
/// `abaqus` is the section of [Shoop2001] (eq 12). `matsuoka_nakai` is the section of both smooth
/// cones of friction, I1 I2/I3 = const [Matsuoka1974] and I1^3/I3 = const [Lade1975]: with the same
/// strengths in compression and extension they are the same curve. The sections are convex from K =
/// 7/9 (abaqus) and K = 1/2 (matsuoka_nakai) on.

#include "furrow/core/options/options.h"
#include "furrow/material/material.h"
#include "furrow/material/section/section_parameters.h"

namespace furrow {

/// Adds the keys K and section to those of a law.
void declare_section(Schema& law);
/// @throws InputError for a K that the section does not have
SectionParameters make_section(const Options& law);
/// t [Pa]
double yield_measure(const Invariants& stress, const SectionParameters& section);

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How the strength of a law depends on the kind of strain: the section of its yield surface by a
/// plane of constant p. Declared options and queries; the update is in deviatoric_return.h.
///
///   t = q g(c),  c = cos(3 theta) = (r/q)^3,  r^3 = (27/2) det s
///
/// c is -1 in triaxial compression, where g = 1, and 1 in extension, where g = 1/K.
///
///   abaqus          g = [1 + 1/K - (1 - 1/K) c]/2         [Shoop2001] (eq 12), material.h
///   matsuoka_nakai  (1 - w) g^3 - g = w c,  w = (1 - K^2)/(1 + K^3), the largest root
///
/// The last is the section of both smooth cones of friction. At one p, I1 I2/I3 = const
/// ([Matsuoka1974]) and I1^3/I3 = const ([Lade1975]) have the form q^2 (A + B q c) = const: with
/// the same strengths in compression and extension they are the same curve. Equal friction angles
/// phi in both are K = (3 - sin(phi))/(3 + sin(phi)). The sections are convex from K = 7/9 (abaqus)
/// and K = 1/2 (matsuoka_nakai) on; K = 0.6 is a friction angle of 48.6 degrees.

#include "core/options.h"
#include "material/material.h"
#include "material/section/section_parameters.h"

namespace furrow {

/// Adds the keys K and section to those of a law.
void declare_section(Schema& law);
/// @throws InputError for a K that the section does not have
SectionParameters make_section(const Options& law);
/// t [Pa]
double yield_measure(const Invariants& stress, const SectionParameters& section);

}  // namespace furrow

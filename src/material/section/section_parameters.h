// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The deviatoric section of a law, as plain data for the kernels (section.h has the equations).

namespace furrow {

struct SectionParameters {
  enum class Kind { round, abaqus, matsuoka_nakai };
  Kind kind = Kind::round;
  double K = 1.0;  ///< flow stress ratio: q in triaxial extension over q in compression
  double w = 0.0;  ///< of matsuoka_nakai
};

}  // namespace furrow

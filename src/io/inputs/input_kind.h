// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The kinds of YAML files that Furrow reads, distinguished by their sections.

#include "furrow/io/formats/yaml_tree.h"

namespace furrow {

enum class InputKind { material, tyre, brick_tyre, point_run, point_fit };

/// True for a file with a section that only this kind has.
bool is_kind(const YamlTree& file, InputKind kind);

/// @throws InputError when a file has no section of the kind that is expected, but one of another
/// kind: which one it looks like, and what reads that
void check_kind(const YamlTree& file, InputKind expected);

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Private members of LIGGGHTS's classes: an explicit template instantiation may name them.

namespace furrow::coupling::exposed {

/// Instantiated explicitly, it defines the function that a tag of this namespace declares, `friend
/// type member(Tag)`, which hands the pointer to member out.
template <class Tag, typename Tag::type Member>
struct Expose {
  friend typename Tag::type member(Tag) { return Member; }
};

}  // namespace furrow::coupling::exposed

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

/// The tag of `Type Class::*name`, and the function that it declares; within this namespace.
#define FURROW_EXPOSE(Tag, Class, Type, name) \
  struct Tag {                                \
    using type = Type Class::*;               \
    friend type member(Tag);                  \
  };                                          \
  template struct Expose<Tag, &Class::name>

}  // namespace furrow::coupling::exposed

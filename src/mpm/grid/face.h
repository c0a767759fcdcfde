// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The six faces of the background grid, and a value for each of them.

#include <array>
#include <cstddef>

namespace furrow {

enum class Face { x_lower, x_upper, y_lower, y_upper, z_lower, z_upper };

constexpr std::size_t face_count = 6;
constexpr std::array<Face, face_count> all_faces = {Face::x_lower, Face::x_upper, Face::y_lower,
                                                    Face::y_upper, Face::z_lower, Face::z_upper};

/// The axis that a face lies across: 0 x, 1 y, 2 z.
constexpr int axis_of(Face face) { return static_cast<int>(face) / 2; }
constexpr bool is_upper(Face face) { return static_cast<int>(face) % 2 == 1; }
constexpr Face opposite(Face face) { return static_cast<Face>(static_cast<int>(face) ^ 1); }

/// One value for each face, in the order of Face.
template <class T>
struct FaceArray {
  std::array<T, face_count> values;

  T& operator[](Face face) { return values[static_cast<std::size_t>(face)]; }
  const T& operator[](Face face) const { return values[static_cast<std::size_t>(face)]; }
  auto begin() { return values.begin(); }
  auto end() { return values.end(); }
  void fill(const T& value) { values.fill(value); }
};

}  // namespace furrow

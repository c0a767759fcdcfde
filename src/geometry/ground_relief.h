// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The initial surface of ground that is not flat: heights above its level.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/core/options/options.h"
#include "furrow/core/types.h"

namespace furrow {

/// Heights at the nodes of a regular grid, x fastest.
struct Heightmap {
  std::string name;                   ///< for errors
  Vector2 lower = Vector2::Zero();    ///< node of the lowest x and y [m]
  Vector2 spacing = Vector2::Zero();  ///< of nodes [m]
  int columns = 0, rows = 0;          ///< along x, along y
  std::vector<double> heights = {};   ///< [m]
  std::string note = {};              ///< steps of a reader that made a grid of them, for a person

  /// Bilinear. A node stands for half a spacing around it, so that the map ends there.
  /// @throws InputError outside of the map
  double height(double x, double y) const;
};

/// A random profile along x with the spectrum of ISO 8608: the displacement spectral density is
/// G(n) = G(n0) (n/n0)^-2 over the spatial frequency n, with n0 = 0.1 cycles/m.
struct Roughness {
  /// Geometric mean of G(n0) of a road class, A to H [m^3]: each is 4 times that of the one before.
  static double mean_density(char road_class);

  double density = 0.0;                   ///< G(n0) [m^3]
  double lowest = 0.011, highest = 2.83;  ///< spatial frequencies [cycles/m]
  std::uint32_t seed = 1;
};

struct ReliefParameters {
  std::shared_ptr<const Heightmap> heightmap = {};  ///< may be large
  std::optional<Vector2> washboard = {};            ///< wavelength, amplitude [m]
  std::optional<Roughness> roughness = {};
  std::optional<Eigen::Vector4d> trapezoid =
      {};  ///< x of the middle, height, length of top, of base [m]
  std::optional<Vector2> half_cylinder = {};  ///< x of the axis, radius [m]
  std::optional<double> flat_until = {};      ///< x where washboard and roughness begin [m]
};

/// The sum of all given shapes, a function of the place alone.
class GroundRelief {
 public:
  GroundRelief() = default;  ///< flat
  /// @throws InputError for a shape that cannot be
  GroundRelief(ReliefParameters parameters, const std::string& where);

  bool flat() const { return flat_; }
  /// Height at a place [m]. @throws InputError outside of a heightmap
  double height(double x, double y) const { return profile(x) + map_height(x, y); }
  double profile(double x) const;               ///< of all shapes but the heightmap [m]
  double map_height(double x, double y) const;  ///< [m] @throws InputError outside of it
  /// Checks a heightmap, if there is one, for a ground from a lower to an upper corner [m].
  /// @throws InputError for a map that is coarser, higher or steeper than such a ground can be
  void check_map(const Vector2& lower, const Vector2& upper) const;
  /// Warnings of shapes that ground of this length and cell [m] cannot show, a sentence each.
  /// @param moves  with a wheel, over any distance
  std::vector<std::string> warnings(double length, double cell, bool moves) const;
  /// Checksum of the heightmap's nodes, equal for equal maps; empty without a map.
  std::string map_checksum() const;
  std::string note() const;  ///< of the heightmap; empty without
  /// Requires the same heightmap in a run that continues. Keywords are compared by the fix.
  void match(Checkpoint& state) const;

 private:
  struct Wave {
    double amplitude, wave_number, phase;  // [m], [rad/m], [rad]
  };
  void add_waves(const Roughness& roughness);
  double waves_at(double x) const;

  ReliefParameters parameters_;
  bool flat_ = true;
  std::vector<Wave> waves_;
  double waves_at_start_ = 0.0;  // [m]
};

/// The keys of a relief but for those of its heightmap's file, which are read by io.
void declare_relief(Schema& schema);
/// Relief from the keys of a line. @param heightmap  of the file that the line names
GroundRelief relief_from(const Options& options, std::shared_ptr<const Heightmap> heightmap);

}  // namespace furrow

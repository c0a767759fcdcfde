// SPDX-License-Identifier: GPL-2.0-or-later
// How much of the ground under a rolling wheel could be left out of the steps, for several bounds s
// on the stress. A block of 4 x 4 x 4 cells is at rest if for 4 ms no stress component changes by
// more than s. No particle in it may be faster than s/(rho c), the velocity of a wave of that
// stress. Means over the last 0.2 m. Without blocks at rest a step is at most 1/(1 - share) times
// cheaper. The program also prints the force that moving blocks no longer get, over the load: at
// most s in each direction on the faces between blocks at rest and moving blocks.
//   build/tests/benchmarks/ground_at_rest [cell in m] [metres of rolling] [material file] [cfl]

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>

#include <fmt/format.h>

#include "../support/wheel_on_ground.h"

namespace furrow {
namespace {

constexpr double interval = 4e-3;                                                  // [s]
constexpr std::array<double, 6> bounds{10.0, 50.0, 150.0, 500.0, 1500.0, 5000.0};  // [Pa]

/// What has happened in a block since the interval began.
struct Block {
  double particles = 0.0;
  double stress_change = 0.0;  // [Pa]
  double speed = 0.0;          // [m/s]
};

/// Sums over blocks and intervals of what one bound leaves out.
struct AtRest {
  double particles = 0.0;
  double area = 0.0;  // of the faces between blocks at rest and blocks that move [m2]
};

/// One interval; ends early when the ground moves on, and then counts for nothing.
class Interval {
 public:
  Interval(WheelOnGround& scene, double cell)
      : soil_(scene.soil()), edge_(4.0 * cell), generation_(soil_.generation()) {
    const Particles& particles = soil_.unsynchronised_groups()[0].particles;
    for (std::size_t s = 0; s < stress_.size(); ++s) {
      const double* stress = particles.data(column::state + field::stress + s);
      stress_[s].assign(stress, stress + particles.size());
    }
  }
  bool whole() const { return soil_.generation() == generation_; }
  void look() {
    if (!whole()) return;
    const Particles& particles = soil_.unsynchronised_groups()[0].particles;
    const bool first = blocks_.empty();
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Vector3 place = particles.position(p) / edge_;
      Block& block =
          blocks_[{std::lround(std::floor(place.x())), std::lround(std::floor(place.y())),
                   std::lround(std::floor(place.z()))}];
      if (first) block.particles += 1.0;
      block.speed = std::max(block.speed, particles.velocity(p).norm());
      for (std::size_t s = 0; s < stress_.size(); ++s)
        block.stress_change = std::max(
            block.stress_change,
            std::abs(particles.data(column::state + field::stress + s)[p] - stress_[s][p]));
    }
  }
  /// @param impedance  rho c of the undisturbed ground [Pa s/m]
  void add_to(std::array<AtRest, bounds.size()>& at_rest, double& all, double impedance) const {
    for (const auto& [place, block] : blocks_) {
      all += block.particles;
      for (std::size_t b = 0; b < bounds.size(); ++b) {
        const double bound = bounds[b];
        if (!rests(block, bound, impedance)) continue;
        at_rest[b].particles += block.particles;
        for (const auto& side : sides) {
          const auto next =
              blocks_.find({place[0] + side[0], place[1] + side[1], place[2] + side[2]});
          if (next != blocks_.end() && !rests(next->second, bound, impedance))
            at_rest[b].area += edge_ * edge_;
        }
      }
    }
  }

 private:
  static constexpr std::array<std::array<long, 3>, 6> sides{
      {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
  static bool rests(const Block& block, double bound, double impedance) {
    return block.stress_change <= bound && block.speed <= bound / impedance;
  }

  ContinuumTerrain& soil_;
  double edge_;
  unsigned long generation_;
  std::array<std::vector<double>, 6> stress_;
  std::map<std::array<long, 3>, Block> blocks_;
};

int run(int argc, char** argv) {
  WheelOnGround::Ground ground;
  if (argc > 1) ground.cell = std::atof(argv[1]);
  const double roll = argc > 2 ? std::atof(argv[2]) : 0.6;
  if (argc > 3) ground.material = argv[3];
  ground.cfl = argc > 4 ? std::atof(argv[4]) : 0.65;
  WheelOnGround scene(ground);
  const Material& material = *scene.soil().groups()[0].material;
  const double impedance = material.density() * material.wave_speed(material.initial_state());
  std::array<AtRest, bounds.size()> at_rest{};
  double all = 0.0, intervals = 0.0;
  while (scene.time() < WheelOnGround::end_of(roll - 0.2)) scene.step();
  while (scene.time() < WheelOnGround::end_of(roll)) {
    Interval quiet(scene, ground.cell);
    const double end = scene.time() + interval;
    for (quiet.look(); scene.time() < end && quiet.whole(); quiet.look()) scene.step();
    if (!quiet.whole()) continue;
    quiet.add_to(at_rest, all, impedance);
    intervals += 1.0;
  }
  constexpr double half_load = 0.5 * WheelOnGround::load;
  fmt::print("bound on the stress [Pa]  on the velocity [m/s]  at rest [%]  force over load [%]\n");
  for (std::size_t b = 0; b < bounds.size(); ++b)
    fmt::print("{:24g}  {:21.2e}  {:11.1f}  {:19.1f}\n", bounds[b], bounds[b] / impedance,
               100.0 * at_rest[b].particles / all,
               100.0 * bounds[b] * at_rest[b].area / intervals / half_load);
  return 0;
}

}  // namespace
}  // namespace furrow

int main(int argc, char** argv) { return furrow::run(argc, argv); }

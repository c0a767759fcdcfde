// SPDX-License-Identifier: GPL-2.0-or-later
// Cost of a step of the tyre with a tread of bricks on a rigid plane, where its step comes from,
// and what 2 m of rolling at 8 km/h take by that.
//   build/tests/benchmarks/brick_tyre_step
// P235/75 R15 at 241 kPa, pressed by 3 cm, friction 0.8. Arguments: sections round the tyre; 1 for
// half of it.

#include <algorithm>
#include <limits>
#include <string>

#include <benchmark/benchmark.h>

#include "furrow/bodies/rigid_plane.h"
#include "furrow/io/inputs/brick_tyre_file.h"
#include "furrow/tyre/brick/brick_tyre.h"

namespace furrow {
namespace {

constexpr double depth = 0.03;                 // [m]
constexpr double lowering_speed = 3.0;         // [m/s]
constexpr double rolling_time = 2.0 / 2.2222;  // [s]

BrickTyreParameters tyre_of(const std::string& tread) {
  return read_brick_tyre_file(FURROW_SOURCE_DIR "/inputs/tyres/p235_75r15_" + tread + ".yaml");
}

/// Elements, and the stress-free steps [us] of the fastest shell and brick.
void count_elements(benchmark::State& timer, const BrickTyreParameters& tyre, int sections,
                    bool half) {
  const BrickTyreMesh mesh = make_brick_tyre_mesh(tyre, sections, half);
  double shells = 0.0, shell_step = std::numeric_limits<double>::infinity();
  for (std::size_t zone = 0; zone < mesh.quads.size(); ++zone) {
    const CarcassZone& of = tyre.carcass.zones[zone];
    const Shell4 shell(mesh.x, mesh.quads[zone], ShellSection(of.wall, of.areal_mass),
                       [](const Vector3& at) { return Vector3(-at.z(), 0.0, at.x()); });
    shells += static_cast<double>(mesh.quads[zone].size());
    shell_step = std::min(shell_step, shell.stable_time_step());
  }
  const Brick8 bricks(mesh.x, mesh.bricks, tyre.tread.rubber);
  timer.counters["nodes"] = static_cast<double>(mesh.x.cols());
  timer.counters["shells"] = shells;
  timer.counters["bricks"] = static_cast<double>(mesh.bricks.size());
  timer.counters["shell_us"] = 1e6 * shell_step;
  timer.counters["brick_us"] = 1e6 * bricks.stable_time_step();
}

void BM_step(benchmark::State& timer, const std::string& tread) {
  BrickTyreSettings settings;
  settings.sections = static_cast<int>(timer.range(0));
  settings.half = timer.range(1) != 0;
  const BrickTyreParameters parameters = tyre_of(tread);
  BrickTyre tyre(parameters, settings, {{30.0, 1.0, 0.6}, Vector3::Zero()});
  SettleOptions inflated;
  inflated.tolerance = 0.1;
  tyre.settle(nullptr, inflated);
  tyre.prescribe(Coordinate::z, -lowering_speed);
  RigidPlaneParameters road;
  road.height = tyre.lowest_tread_height();
  road.friction = 0.8;
  RigidPlane plane(road, tyre.surface());
  double dt = 0.0;
  const auto step = [&] {
    tyre.surface().clear_forces();
    plane.press_on(tyre.surface());
    dt = tyre.stable_time_step();
    tyre.advance(dt);
  };
  while (tyre.centre().z() > -depth) step();
  tyre.hold(Coordinate::z);
  for (auto _ : timer) step();
  count_elements(timer, parameters, settings.sections, settings.half);
  timer.counters["dt_us"] = 1e6 * dt;
  using benchmark::Counter;
  timer.counters["core_s_2m"] =
      Counter(dt / rolling_time, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

BENCHMARK_CAPTURE(BM_step, smooth, "smooth")
    ->Args({60, 1})
    ->Args({120, 1})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BM_step, ribbed, "ribbed")
    ->Args({60, 1})
    ->Args({120, 0})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace furrow

BENCHMARK_MAIN();

// SPDX-License-Identifier: GPL-2.0-or-later
// Cost of a step of a tyre on a rigid plane: shell, sidewalls by table, damping, contact hand-over,
// hub, plane; and of bringing a tyre to rest.
//   build/tests/benchmarks/tyre_step
// The whole P235/75 R15 at 241 kPa, pressed by 3 cm, four rows of contact nodes on each sidewall.

#include <benchmark/benchmark.h>

#include "furrow/bodies/rigid_plane.h"
#include "furrow/io/inputs/tyre_file.h"
#include "furrow/tyre/darnell/darnell_tyre.h"

namespace furrow {
namespace {

DarnellTyre make_tyre(int across, int around) {
  DarnellTyreSettings settings;
  settings.across = across;
  settings.around = around;
  return DarnellTyre(read_tyre_file(FURROW_SOURCE_DIR "/inputs/tyres/p235_75r15.yaml"), settings,
                     {{30.0, 1.0, 0.6}, Vector3::Zero()});
}

/// Elements across and around are the benchmark's arguments.
void BM_step(benchmark::State& timer) {
  DarnellTyre tyre = make_tyre(static_cast<int>(timer.range(0)), static_cast<int>(timer.range(1)));
  RigidPlaneParameters road;
  road.height = -tyre.nominal_radius();
  road.friction = 0.8;
  RigidPlane plane(road, tyre.surface());
  const double dt = 0.5 * tyre.stable_time_step();
  const auto step = [&] {
    tyre.surface().clear_forces();
    plane.press_on(tyre.surface());
    tyre.advance(dt);
  };
  SettleOptions pressed;
  pressed.axle_height = -0.03;
  tyre.settle(&plane, pressed);
  for (auto _ : timer) step();
  timer.counters["elements"] = static_cast<double>(timer.range(0) * timer.range(1));
}

/// Interval that a coupled system asks for where only grains press: forces held over seven
/// sub-steps, the surface needed at its end.
void BM_interval(benchmark::State& timer) {
  DarnellTyre tyre = make_tyre(static_cast<int>(timer.range(0)), static_cast<int>(timer.range(1)));
  constexpr int sub_steps = 7;
  const double dt = 0.9 * tyre.stable_time_step();
  for (auto _ : timer) {
    tyre.begin_interval(false);
    for (int i = 0; i < sub_steps; ++i) tyre.advance(dt);
    tyre.end_interval();
  }
}

void BM_settle(benchmark::State& timer) {
  for (auto _ : timer) {
    timer.PauseTiming();  // the sidewalls' tables
    DarnellTyre tyre =
        make_tyre(static_cast<int>(timer.range(0)), static_cast<int>(timer.range(1)));
    timer.ResumeTiming();
    tyre.settle(nullptr);
  }
}

BENCHMARK(BM_step)->Args({6, 72})->Args({12, 144})->Unit(benchmark::kMicrosecond);
BENCHMARK(BM_interval)->Args({6, 72})->Args({12, 144})->Unit(benchmark::kMicrosecond);
BENCHMARK(BM_settle)->Args({4, 36})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace furrow

BENCHMARK_MAIN();

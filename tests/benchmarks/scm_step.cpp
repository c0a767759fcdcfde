// SPDX-License-Identifier: GPL-2.0-or-later
// Cost of a rigid wheel on a height field, by both contacts, and how many times faster than real
// time it rolls:
//   build/tests/benchmarks/scm_step
// A loaded wheel is driven in steps of 0.5 ms.

#include <benchmark/benchmark.h>

#include "furrow/bodies/coupled_system.h"
#include "furrow/bodies/rigid_wheel.h"
#include "furrow/scm/rft_contact.h"
#include "furrow/scm/scm_contact.h"

namespace furrow {
namespace {

constexpr double radius = 0.25, speed = 0.5, slip = 0.2, step = 5e-4;  // [m], [m/s], [s]
constexpr double length = 40.0;                                        // of the ground [m]

Soil sand() {
  Soil soil;
  soil.k_c = 1370.0;
  soil.k_phi = 814e3;
  soil.cohesion = 800.0;
  soil.friction_angle = radians(37.2);
  soil.shear_length = 0.015;
  soil.flow = 0.5;
  return soil;
}

/// Times the steps of a wheel that rolls with a given slip, from the start again at the end.
void time_rolling(benchmark::State& timer, CoupledSystem& system, RigidWheel& wheel) {
  wheel.prescribe(Coordinate::x, speed);
  wheel.prescribe(Coordinate::spin, speed / (radius * (1.0 - slip)));
  for (int n = 0; n < 2000; ++n) system.advance(step);
  double simulated = 0.0;
  for (auto _ : timer) {
    if (wheel.centre().x() > length - 3.0) wheel.place(Vector3(0.0, 0.0, radius), 0.0, 0.0);
    system.advance(step);
    simulated += step;
  }
  timer.counters["times_real_time"] = benchmark::Counter(simulated, benchmark::Counter::kIsRate);
  timer.counters["hub_drop_mm"] = 1e3 * (radius - wheel.centre().z());
}

/// Cells per metre are the benchmark's argument.
void BM_roll(benchmark::State& timer) {
  RigidWheelParameters shape;
  shape.geometry.diameter = 2.0 * radius;
  shape.geometry.width = 0.16;
  shape.geometry.shoulder = 0.01;
  shape.hub.inertia = {25.0, 0.8, 0.5};
  shape.hub.centre = Vector3(0.0, 0.0, radius);
  RigidWheel wheel(shape);
  HeightField field({length, 0.6, Vector2(0.5 * length - 1.0, 0.0), 0.0,
                     1.0 / static_cast<double>(timer.range(0))});
  const Soil soil = sand();
  ScmContact contact(wheel, field, soil, {});
  CoupledSystem system;
  system.add(wheel, "wheel");
  system.add(contact, "contact");
  wheel.release(Coordinate::z);
  wheel.set_vertical_damping(2000.0);
  wheel.set_load(Vector3(0.0, 0.0, -600.0));
  for (int n = 0; n < 2000; ++n) system.advance(step);
  time_rolling(timer, system, wheel);
}

/// A wheel with grousers in sand by resistive force theory. Facets around are the argument.
void BM_rft(benchmark::State& timer) {
  RigidWheelParameters shape;
  shape.geometry.diameter = 2.0 * radius;
  shape.geometry.width = 0.16;
  shape.geometry.segments = static_cast<int>(timer.range(0));
  shape.geometry.grousers.number = 24;
  shape.geometry.grousers.height = 0.02;
  shape.geometry.grousers.thickness = 0.006;
  shape.hub.inertia = {25.0, 0.8, 0.5};
  shape.hub.centre = Vector3(0.0, 0.0, radius);
  RigidWheel wheel(shape);
  HeightField field({length, 0.6, Vector2(0.5 * length - 1.0, 0.0), 0.0, 0.05});
  RftContact contact(wheel, field, {2e6, 0.5, 1e-3});
  CoupledSystem system;
  system.add(wheel, "wheel");
  system.add(contact, "contact");
  wheel.release(Coordinate::z);
  wheel.set_vertical_damping(500.0);
  wheel.set_load(Vector3(0.0, 0.0, -600.0));
  time_rolling(timer, system, wheel);
  timer.counters["triangles"] = static_cast<double>(wheel.surface().triangle_count());
}

BENCHMARK(BM_rft)->Arg(60)->Arg(240)->Unit(benchmark::kMicrosecond);
BENCHMARK(BM_roll)->Arg(50)->Arg(100)->Arg(200)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace furrow

BENCHMARK_MAIN();

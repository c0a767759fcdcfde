// SPDX-License-Identifier: GPL-2.0-or-later
// Cost of a sidewall: microseconds for each station of a side, looked up and solved, with and
// without the stiffness; and of making a table.
//   build/tests/benchmarks/sidewall_cost
// The stations of a 6 x 72 tyre, both sides: the tread's edge dips into a contact patch and moves
// on with every evaluation, as in rolling at 2 m/s with steps of 2e-5 s.

#include <algorithm>
#include <cmath>
#include <vector>

#include <benchmark/benchmark.h>

#include "furrow/io/inputs/tyre_file.h"
#include "furrow/tyre/sidewall/sidewall_direct.h"
#include "furrow/tyre/sidewall/sidewall_table.h"

namespace furrow {
namespace {

constexpr std::size_t stations = 144;

TyreParameters tyre() { return read_tyre_file(FURROW_SOURCE_DIR "/inputs/tyres/p235_75r15.yaml"); }

void place(std::vector<SidewallEnd>& ends, const Vector2& chord, double turned) {
  for (std::size_t i = 0; i < stations; ++i) {
    const double angle =
        std::remainder(2.0 * pi * static_cast<double>(i % 72) / 72.0 + turned, 2.0 * pi);
    const double dent = std::exp(-std::pow(angle / 0.35, 2));
    ends[i] = {chord[0] + 0.004 * dent, chord[1] - 0.05 * dent, 0.2 * dent};
  }
}

void measure(benchmark::State& timer, Sidewall& sidewall, bool with_stiffness) {
  const Vector2 chord = tyre().sidewall_chord();
  std::vector<SidewallEnd> ends(stations);
  std::vector<SidewallResponse> responses(stations);
  double turned = 0.0;
  for (auto _ : timer) {
    place(ends, chord, turned += 1.2e-4);
    sidewall.evaluate(ends.data(), responses.data(), stations, with_stiffness);
    benchmark::DoNotOptimize(responses.data());
  }
  timer.counters["us_per_station"] = benchmark::Counter(
      1e-6 * stations, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void BM_table(benchmark::State& timer) {
  SidewallTable sidewall(tyre().sidewall, 241e3);
  measure(timer, sidewall, false);
}
void BM_table_with_stiffness(benchmark::State& timer) {
  SidewallTable sidewall(tyre().sidewall, 241e3);
  measure(timer, sidewall, true);
}
void BM_direct(benchmark::State& timer) {
  SidewallDirect sidewall(tyre().sidewall, 241e3);
  measure(timer, sidewall, false);
}
void BM_direct_with_stiffness(benchmark::State& timer) {
  SidewallDirect sidewall(tyre().sidewall, 241e3);
  measure(timer, sidewall, true);
}

/// Nodes along the chord, half and a quarter as many along the other two axes; with the error that
/// is bought, rms of all cells.
void BM_making_a_table(benchmark::State& timer) {
  const SidewallParameters sidewall = tyre().sidewall;
  SidewallTableGrid grid;
  grid.chord_nodes = static_cast<int>(timer.range(0));
  grid.direction_nodes = grid.chord_nodes / 2;
  grid.rotation_nodes = std::max(6, grid.chord_nodes / 4);
  for (auto _ : timer) SidewallTable(sidewall, 241e3, grid);
  SidewallTable table(sidewall, 241e3, grid);
  const SidewallTable::Accuracy accuracy = table.accuracy(0.97);
  timer.counters["rms_N_per_m"] = accuracy.force_rms;
  timer.counters["max_N_per_m"] = accuracy.force_max;
  timer.counters["kB"] = static_cast<double>(table.coefficients().size() * sizeof(double)) / 1024.0;
}

BENCHMARK(BM_table)->Unit(benchmark::kMicrosecond);
BENCHMARK(BM_table_with_stiffness)->Unit(benchmark::kMicrosecond);
BENCHMARK(BM_direct)->Unit(benchmark::kMicrosecond);
BENCHMARK(BM_direct_with_stiffness)->Unit(benchmark::kMicrosecond);
BENCHMARK(BM_making_a_table)
    ->Arg(12)
    ->Arg(16)
    ->Arg(24)
    ->Arg(32)
    ->Arg(48)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace furrow

BENCHMARK_MAIN();

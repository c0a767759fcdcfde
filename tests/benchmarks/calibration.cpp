// SPDX-License-Identifier: GPL-2.0-or-later
/// The unit of all speeds on pages: the time of 1000 multiply-adds on doubles in the first-level
/// cache. Divide a time that another benchmark measures by it to compare machines.

#include <array>

#include <benchmark/benchmark.h>

namespace {

void multiply_add(benchmark::State& state) {
  std::array<double, 1000> x, y;
  x.fill(1.0);
  y.fill(0.0);
  double factor = 1e-9;
  benchmark::DoNotOptimize(factor);
  for (auto _ : state) {
    for (std::size_t n = 0; n < x.size(); ++n) y[n] += factor * x[n];
    benchmark::DoNotOptimize(y.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(multiply_add);

}  // namespace

BENCHMARK_MAIN();

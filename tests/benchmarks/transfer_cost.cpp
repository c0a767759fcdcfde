// SPDX-License-Identifier: GPL-2.0-or-later
// Cost of the transfers between particles and grid alone, nanoseconds a particle of CPU time: 50 x
// 16 x 8 cells with 8 particles each in the order of their cells, as the ground keeps them,
// slightly displaced.
//   build/tests/benchmarks/transfer_cost
// The environment variable FURROW_ISA = baseline | avx2 | avx512 selects the kernels.

#include <random>

#include <benchmark/benchmark.h>

#include "furrow/material/registry.h"
#include "furrow/mpm/grid/grid.h"
#include "furrow/mpm/particles/particles.h"

namespace furrow {
namespace {

class Scene {
 public:
  Scene()
      : material_(make_material(
            "elastic", std::vector<Entry>{{"density", {"200"}}, {"E", {"1e6"}}, {"nu", {"0.3"}}})),
        grid_(axis(50), axis(16), axis(8)),
        particles_(*material_) {
    grid_.store(grid_.all_nodes());
    std::mt19937 engine(1);
    std::uniform_real_distribution<double> shake(-0.2, 0.2);
    for (int i = 0; i < 50; ++i)
      for (int j = 0; j < 16; ++j)
        for (int k = 0; k < 8; ++k)
          for (int n = 0; n < 8; ++n) {
            const std::size_t p = particles_.append(1);
            particles_.data(column::x)[p] = i + 0.25 + 0.5 * (n & 1) + shake(engine);
            particles_.data(column::y)[p] = j + 0.25 + 0.5 * ((n >> 1) & 1) + shake(engine);
            particles_.data(column::z)[p] = k + 0.25 + 0.5 * ((n >> 2) & 1) + shake(engine);
            for (std::size_t a = 0; a < 3; ++a)
              particles_.data(column::quadrature_x + a)[p] = particles_.data(column::x + a)[p];
            particles_.data(column::volume)[p] = 0.125;
            particles_.set_state(p, material_->initial_state());
          }
    for (double*& g : gradient_) {
      store_.emplace_back(chunk);
      g = store_.back().data();
    }
  }
  static Axis axis(int cells) {
    return Axis({0.0, double(cells), 1.0, 0.0, double(cells), 1.0}, "axis");
  }
  void momentum() { kernels_.scatter_momentum(grid_.view(), view(), 200.0); }
  void weights() {
    for (std::size_t first = 0; first < size(); first += chunk)
      kernels_.find_weights(grid_.view(), part(first), weights_.data());
  }
  /// Kernels of a step without a transfer, by chunks as the ground calls them.
  void step() {
    for (std::size_t first = 0; first < size(); first += chunk) {
      const ParticleView particles = part(first);
      kernels_.find_weights(grid_.view(), particles, weights_.data());
      kernels_.gather_strain(grid_.view(), particles, weights_.data(), 1e-9, gradient_.data());
      kernels_.scatter_force(grid_.view(), particles, weights_.data());
    }
  }
  void motion() { kernels_.gather_motion(grid_.view(), view(), 0.95); }
  std::size_t size() const { return particles_.size(); }

 private:
  static constexpr std::size_t chunk = 1024;
  ParticleView part(std::size_t first) {
    return particles_.view(first, std::min(chunk, size() - first));
  }
  ParticleView view() { return particles_.view(0, particles_.size()); }

  const TransferKernels& kernels_ = transfer_kernels();
  std::unique_ptr<Material> material_;
  Grid grid_;
  Particles particles_;
  std::vector<std::vector<double>> store_;
  std::array<double*, 9> gradient_;
  std::vector<Weights> weights_{batches(chunk)};
};

void report(benchmark::State& state, const Scene& scene) {
  state.counters["ns/particle"] = benchmark::Counter(
      double(scene.size()) * 1e-9,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <void (Scene::*part)()>
void run(benchmark::State& state) {
  Scene scene;
  for (auto _ : state) (scene.*part)();
  report(state, scene);
}

// At every step:
BENCHMARK(run<&Scene::step>)
    ->Name("weights, strain from grid, force to grid")
    ->Unit(benchmark::kMillisecond);
BENCHMARK(run<&Scene::weights>)->Name("of that, weights")->Unit(benchmark::kMillisecond);
// Once in a remap interval:
BENCHMARK(run<&Scene::momentum>)->Name("momentum to grid")->Unit(benchmark::kMillisecond);
BENCHMARK(run<&Scene::motion>)->Name("motion from grid")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace furrow

BENCHMARK_MAIN();

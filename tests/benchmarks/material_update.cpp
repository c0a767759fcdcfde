// SPDX-License-Identifier: GPL-2.0-or-later
// Cost of constitutive updates: blocks of 1e5 points, nanoseconds per point and as a multiple of
// the elastic update alone, with the share of points in each branch. Every iteration starts from
// the same states, so that the mix of branches stays.
//   build/tests/benchmarks/material_update [--benchmark_filter=...]
// The environment variable FURROW_ISA = baseline | avx2 | avx512 selects the kernels.

#include <random>

#include <benchmark/benchmark.h>

#include "../unit/material/plain_elastic.h"
#include "furrow/material/registry.h"
#include "furrow/simd/dispatch.h"
#include "furrow/testing/material_text.h"

namespace furrow {
namespace {

constexpr std::size_t point_count = 100000;

/// Points with their own random states and steps of about the strain that an explicit wheel scene
/// takes.
class Points {
 public:
  /// @param run  points in a row that are nearly alike, as sorted points of a ground are; 1: every
  /// point on its own
  Points(const Material& material, double strain, double loosening, std::size_t run, unsigned seed)
      : run_(run) {
    std::mt19937 engine(seed);
    std::normal_distribution<double> normal;
    gradient_.assign(9, std::vector<double>(point_count));
    VectorX state = material.initial_state();
    state_.assign(static_cast<std::size_t>(state.size()), std::vector<double>(point_count));
    for (std::size_t f = 0; f < state_.size(); ++f)
      state_[f].assign(point_count, state[static_cast<Eigen::Index>(f)]);
    bind();
    // A history of compaction, shear and unloading, larger than the step measured, to spread the
    // states over the surfaces.
    for (int step = 0; step < 6; ++step) {
      draw(engine, normal, step < 4 ? 10 * strain : strain, step < 4 ? -0.5 : loosening);
      material.update_block(block_);
    }
    draw(engine, normal, strain, loosening);
    start_ = state_;
  }
  void restore() {
    for (std::size_t f = 0; f < state_.size(); ++f)
      std::copy(start_[f].begin(), start_[f].end(), state_[f].begin());
  }
  const PointBlock& block() const { return block_; }

 private:
  void bind() {
    pointers_.clear();
    for (auto& array : state_) pointers_.push_back(array.data());
    block_.size = point_count;
    for (std::size_t k = 0; k < 9; ++k) block_.gradient[k] = gradient_[k].data();
    block_.state = pointers_.data();
  }
  void draw(std::mt19937& engine, std::normal_distribution<double>& normal, double strain,
            double mean) {
    for (std::size_t k = 0; k < 9; ++k) {
      double common = 0.0;
      for (std::size_t i = 0; i < point_count; ++i) {
        if (i % run_ == 0) common = 0.6 * normal(engine);
        const double own = run_ == 1 ? 0.0 : 0.03 * normal(engine);
        gradient_[k][i] = strain * (common + own + (k % 4 == 0 ? mean : 0.0));
      }
    }
  }

  std::vector<std::vector<double>> gradient_, state_, start_;
  std::vector<double*> pointers_;
  PointBlock block_;
  std::size_t run_;
};

std::string elastic() { return "elastic density 200 E 13.79e6 nu 0.3"; }

/// Fresh snow, [Shoop2001] Tables 1 and 3. @param shape K, alpha and section
std::string snow(const std::string& shape = "K 1 alpha 0",
                 const std::string& interpolation = "linear") {
  return "drucker_prager_cap density 200 d 5e3 beta 22.53 R 0.02 eps_vol_pl_0 0.001 " + shape +
         " E 13.79e6 nu 0.3 hardening table p 113.76 5e4 1e5 2e5 5e5 1e6 2e6 2.8e6 3.25e6 6e6 6e7 "
         "eps_vol_pl 0 0.593 0.669 0.806 0.944 1.083 1.299 1.455 1.475 1.50 1.514 beyond "
         "extrapolate interpolation " +
         interpolation;
}

std::string foam() {
  return "crushable_foam density 200 pt 11.376 sigma0 275.79 elasticity porous elasticity.kappa "
         "0.005 elasticity.e0 3.5 pt_el 113.76 nu 0.3 "
         "hardening exponential pc0 113.76 lambda 0.35 hardening.kappa 0.005 hardening.e0 3.5";
}

/// The table of the snow above, p = 0.413 sigma_1.
std::string compacting(const std::string& interpolation) {
  return " E 13.79e6 nu 0.3 hardening table p 113.76 2.065e4 8.26e4 4.13e5 1.342e6 "
         "eps_vol_pl 0 0.6419 0.8544 1.1314 1.5228 beyond extrapolate interpolation " +
         interpolation;
}

/// Fresh snow of 200 kg/m3 that follows the oedometer, with K0 = 0.12.
std::string cam_clay(const std::string& interpolation = "linear") {
  return "cohesive_cam_clay density 200 M 3.3 tension_ratio 0.1" + compacting(interpolation);
}

/// The same snow with independent lateral stress and shear strength.
std::string cohesive_cap(const std::string& interpolation = "linear") {
  return "cohesive_cap density 200 nu_p 0.1 d 2e3 d_density 200 d_exponent 3 beta 30 tension_ratio "
         "0.2" +
         compacting(interpolation);
}

/// Dry sand.
std::string norsand(const std::string& shape) {
  return "norsand density 1600 e0 0.66 M 1.2 gamma 0.8 lambda 0.02 chi 3.5 H 100 G 4e7 n 0.5 nu "
         "0.2 section matsuoka_nakai " +
         shape;
}

void measure(benchmark::State& timer, const Material& material, double strain, double loosening,
             std::size_t run = 1) {
  Points points(material, strain, loosening, run, 1);
  UpdateReport report;
  for (auto _ : timer) {
    timer.PauseTiming();
    points.restore();
    timer.ResumeTiming();
    report = material.update_block(points.block());
  }
  timer.SetLabel(to_string(chosen_instruction_set()));
  timer.SetItemsProcessed(static_cast<std::int64_t>(timer.iterations() * point_count));
  timer.counters["ns_per_point"] = benchmark::Counter(
      1e-9 * static_cast<double>(point_count),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  const auto share = [&](Branch branch) {
    return 100.0 * static_cast<double>(report.points[static_cast<std::size_t>(branch)]) /
           static_cast<double>(point_count);
  };
  for (const Branch branch :
       {Branch::elastic, Branch::shear, Branch::transition, Branch::cap, Branch::tension})
    timer.counters["%" + to_string(branch)] = share(branch);
  timer.counters["iterations"] =
      static_cast<double>(report.iterations) / static_cast<double>(point_count);
}

/// @param run as of Points
void add(const char* name, const std::string& material, double strain = 1e-4,
         double loosening = 0.0, std::size_t run = 1) {
  const auto body = [=](benchmark::State& timer) {
    measure(timer, *material_of_text(material), strain, loosening, run);
  };
  benchmark::RegisterBenchmark(name, body)->Unit(benchmark::kMillisecond);
}

// Steps of 1e-4, as an explicit scene takes them. By default every point differs from its
// neighbours: the worst order for vectors. Names state the exceptions.
void add_all() {
  add("BM_elastic", elastic());
  // The same law written point by point, with seven separate variables
  const auto pointwise = [](benchmark::State& timer) {
    const auto material =
        make_material(PlainElastic::model(), entries_of_text("density 200 E 13.79e6 nu 0.3"));
    measure(timer, *material, 1e-4, 0.0);
  };
  benchmark::RegisterBenchmark("BM_elastic_pointwise", pointwise)->Unit(benchmark::kMillisecond);
  add("BM_cap_mixed", snow());
  add("BM_cap_mixed_neighbours_alike", snow(), 1e-4, 0.0, 64);
  add("BM_cap_mixed_transition", snow("K 1 alpha 0.05"));
  add("BM_cap_mixed_log_table", snow("K 1 alpha 0", "log"));
  add("BM_cap_all_compacting", snow(), 1e-4, -1.0);
  add("BM_cap_mixed_large_steps", snow(), 1e-2);
  add("BM_cap_mixed_lode", snow("K 0.8 alpha 0"));
  add("BM_cap_mixed_smooth_cone", snow("K 0.7 alpha 0 section matsuoka_nakai"));
  add("BM_foam_mixed", foam());
  add("BM_cohesive_cap_mixed", cohesive_cap());
  add("BM_cohesive_cap_mixed_log_table", cohesive_cap("log"));
  add("BM_cohesive_cap_all_compacting", cohesive_cap(), 1e-4, -1.0);
  add("BM_cohesive_cap_mixed_large_steps", cohesive_cap(), 1e-2);
  add("BM_cam_clay_mixed", cam_clay());
  add("BM_cam_clay_mixed_neighbours_alike", cam_clay(), 1e-4, 0.0, 64);
  add("BM_cam_clay_mixed_log_table", cam_clay("log"));
  add("BM_cam_clay_all_compacting", cam_clay(), 1e-4, -1.0);
  add("BM_cam_clay_mixed_large_steps", cam_clay(), 1e-2);
  add("BM_norsand_mixed", norsand("N 0.5 K 1"));
  add("BM_norsand_mixed_other_N", norsand("N 0.35 K 1"));
  add("BM_norsand_mixed_smooth_cone", norsand("N 0.5 K 0.72"));
}

}  // namespace
}  // namespace furrow

int main(int count, char** words) {
  furrow::add_all();
  benchmark::Initialize(&count, words);
  if (benchmark::ReportUnrecognizedArguments(count, words)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

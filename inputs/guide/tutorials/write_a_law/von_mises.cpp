// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/models/von_mises/von_mises.h"

#include <algorithm>
#include <cmath>

namespace furrow {

MaterialModel VonMises::model() {
  Schema schema("law von_mises");
  schema.number("density", "kg/m3", Range::positive(), "mass density at the start");
  schema.number("E", "Pa", Range::positive(), "Young's modulus");
  schema.number("nu", "", Range::closed(0.0, 0.499),
                "Poisson's ratio, near 0.5 for saturated clay");
  schema.number("c_u", "Pa", Range::positive(), "undrained shear strength");
  MaterialModel model;
  model.name = "von_mises";
  model.meaning = "saturated clay under quick loads";
  model.sections = {law_section(schema)};
  model.create = [](const MaterialOptions& sections) -> std::unique_ptr<Material> {
    const Options& o = sections.at("law").options;
    const double E = o.number("E"), nu = o.number("nu");
    const ElasticModuli moduli{E / (3.0 * (1.0 - 2.0 * nu)), E / (2.0 * (1.0 + nu))};
    return std::make_unique<VonMises>(o.number("density"), moduli, o.number("c_u"));
  };
  model.examples = {"density 1800 E 5e6 nu 0.45 c_u 20e3"};
  return model;
}

VonMises::VonMises(double density, const ElasticModuli& moduli, double c_u)
    : PointwiseMaterial("von_mises", density, {}), moduli_(moduli), largest_q_(2.0 * c_u) {}

void VonMises::step(PointStep& point) const {
  const auto& [K, G] = moduli_;
  const Matrix3 I = Matrix3::Identity();
  const Matrix3 de = point.strain - point.strain.trace() / 3.0 * I;
  const double p_old = -point.stress.trace() / 3.0, p = p_old - K * point.strain.trace();
  const Matrix3 s_old = point.stress + p_old * I;

  Matrix3 s = s_old + 2.0 * G * de;
  const double q = std::sqrt(1.5) * s.norm();
  if (q > largest_q_) {
    s *= largest_q_ / q;
    point.branch = Branch::shear;
  }
  point.stored =
      (p * p - p_old * p_old) / (2.0 * K) + (s.squaredNorm() - s_old.squaredNorm()) / (4.0 * G);
  const Matrix3 de_plastic = de - (s - s_old) / (2.0 * G);
  point.dissipated = 0.5 * (s_old + s).cwiseProduct(de_plastic).sum();
  point.stress = s - p * I;
}

double VonMises::yield_function(const VectorX& state) const {
  return invariants(stress_of(state)).q - largest_q_;
}

double VonMises::stress_scale(const VectorX& state) const {
  return std::max(
      {largest_q_, std::abs(invariants(stress_of(state)).p), 1e-8 * moduli(state).wave()});
}

std::vector<Vector2> VonMises::yield_surface(const VectorX&, std::size_t points) const {
  std::vector<Vector2> line;
  for (std::size_t i = 0; i < points; ++i)
    line.emplace_back(6.0 * largest_q_ * static_cast<double>(i) / static_cast<double>(points),
                      largest_q_);
  return line;
}

}  // namespace furrow

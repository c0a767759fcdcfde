// SPDX-License-Identifier: GPL-2.0-or-later
#include "standard_linear_solid.h"

#include <cmath>

namespace lab {

using furrow::Matrix3;
using furrow::Range;

furrow::MaterialModel StandardLinearSolid::model() {
  furrow::Schema schema("law standard_linear_solid");
  schema.number("density", "kg/m3", Range::positive(), "mass density at the start");
  schema.number("bulk", "Pa", Range::positive(), "bulk modulus");
  schema.number("G_inf", "Pa", Range::positive(), "shear modulus after a long time");
  schema.number("G_1", "Pa", Range::positive(), "shear modulus of the Maxwell element");
  schema.number("tau", "s", Range::positive(), "relaxation time of the Maxwell element");
  furrow::MaterialModel model;
  model.name = "standard_linear_solid";
  model.meaning = "linear viscoelastic in shear: a spring beside a Maxwell element";
  model.sections = {furrow::law_section(schema)};
  model.create = [](const furrow::MaterialOptions& sections) -> std::unique_ptr<furrow::Material> {
    const furrow::Options& o = sections.at("law").options;
    return std::make_unique<StandardLinearSolid>(
        o.number("density"), StandardLinearSolidParameters{o.number("bulk"), o.number("G_inf"),
                                                           o.number("G_1"), o.number("tau")});
  };
  model.examples = {"density 1500 bulk 5e6 G_inf 1e6 G_1 2e6 tau 0.02"};
  return model;
}

StandardLinearSolid::StandardLinearSolid(double density,
                                         const StandardLinearSolidParameters& parameters)
    : PointwiseMaterial("standard_linear_solid", density,
                        {{"maxwell_stress", "Pa", "deviatoric stress of the Maxwell element", 0.0,
                          furrow::StateVariable::Kind::symmetric_tensor}}),
      parameters_(parameters) {}

void StandardLinearSolid::step(furrow::PointStep& point) const {
  const auto& [K, G_inf, G_1, tau] = parameters_;
  const Matrix3 I = Matrix3::Identity();
  const Matrix3 de = point.strain - point.strain.trace() / 3.0 * I;

  const double p_old = -point.stress.trace() / 3.0;
  const Matrix3 h_old = furrow::to_matrix(point.internal.segment<6>(0));
  const Matrix3 s_inf_old = point.stress + p_old * I - h_old;

  const double x = point.time_step / tau;
  const double mean = x > 0.0 ? -std::expm1(-x) / x : 1.0;  // of exp(-t/tau) over the step
  const double rest = x > 1e-3 ? (1.0 - mean) / x : 0.5 - x / 6.0 + x * x / 24.0;
  const double p = p_old - K * point.strain.trace();
  const Matrix3 s_inf = s_inf_old + 2.0 * G_inf * de;
  const Matrix3 h = std::exp(-x) * h_old + 2.0 * G_1 * mean * de;
  const Matrix3 h_mean = mean * h_old + 2.0 * G_1 * rest * de;  // over the step

  const double stored_maxwell = (h.squaredNorm() - h_old.squaredNorm()) / (4.0 * G_1);
  point.stored = (p * p - p_old * p_old) / (2.0 * K) +
                 (s_inf.squaredNorm() - s_inf_old.squaredNorm()) / (4.0 * G_inf) + stored_maxwell;
  point.dissipated = h_mean.cwiseProduct(de).sum() - stored_maxwell;
  point.stress = s_inf + h - p * I;
  point.internal.segment<6>(0) = furrow::to_vector6(h);
}

furrow::ElasticModuli StandardLinearSolid::moduli(const furrow::VectorX&) const {
  return {parameters_.bulk, parameters_.shear_long_term + parameters_.shear_maxwell};
}

}  // namespace lab

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A pointwise law for tests.

#include <cmath>
#include <memory>

#include "furrow/core/error.h"
#include "furrow/material/elasticity/elasticity.h"
#include "furrow/material/pointwise_material.h"

namespace furrow {

/// Hooke's law again, with the strain it has seen as a tensor and a count of its steps; refuses
/// to be compacted to an eighth in one step.
class PlainElastic : public PointwiseMaterial {
 public:
  enum : std::size_t { strain = field::internal, steps = strain + 6 };

  static MaterialModel model() {
    Schema schema("law plain_elastic");
    schema.number("density", "kg/m3", Range::positive(), "mass density at the start");
    MaterialModel model;
    model.name = "plain_elastic";
    model.meaning = "linear elasticity, point by point";
    model.sections = {law_section(schema), elasticity_section()};
    model.create = [](const MaterialOptions& o) -> std::unique_ptr<Material> {
      return std::make_unique<PlainElastic>(o.at("law").options.number("density"),
                                            make_elasticity(o.at("elasticity")));
    };
    model.examples = {"density 1600 E 5e6 nu 0.2"};
    return model;
  }
  PlainElastic(double density, const ElasticityParameters& elasticity)
      : PointwiseMaterial("plain_elastic", density,
                          {{"strain", "", "rotated sum of the increments", 0.0,
                            StateVariable::Kind::symmetric_tensor},
                           {"steps", "", "number of steps", 0.0}}),
        elasticity_(elasticity) {}

  ElasticModuli moduli(const VectorX&) const override {
    return {elasticity_.bulk, elasticity_.shear};
  }

 private:
  void step(PointStep& point) const override {
    if (point.strain.trace() < -2.0) throw StateError("compacted too much");
    const double K = elasticity_.bulk;
    const double G = elasticity_.shear;
    const Matrix3 change =
        (K - 2.0 / 3.0 * G) * point.strain.trace() * Matrix3::Identity() + 2.0 * G * point.strain;
    point.stored = (point.stress + 0.5 * change).cwiseProduct(point.strain).sum();
    point.stress += change;
    point.internal.segment<6>(0) += to_vector6(point.strain);
    point.internal[6] += 1.0;
    point.iterations = 3;
    point.branch = point.internal[6] > 1.5 ? Branch::cap : Branch::elastic;
    point.beyond_data = point.internal[6] > 2.5;
  }

  ElasticityParameters elasticity_;
};

}  // namespace furrow

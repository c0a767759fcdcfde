// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/pointwise_material.h"

#include <algorithm>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/material/pointwise_parameters.h"
#include "furrow/simd/dispatch.h"

namespace furrow {

namespace {

Matrix3 matrix_of(const double* tensor) { return to_matrix(Eigen::Map<const Vector6>(tensor)); }

}  // namespace

PointwiseMaterial::PointwiseMaterial(std::string name, double density,
                                     const std::vector<StateVariable>& internal_variables,
                                     double pressure)
    : Material(std::move(name), density, internal_variables, pressure) {
  const std::size_t numbers = state_fields().size() - field::internal;
  if (numbers > max_pointwise_variables)
    throw Error(fmt::format("law {} keeps {} numbers a point, a pointwise law can keep {}",
                            this->name(), numbers, max_pointwise_variables));
  for (const std::size_t first : tensor_fields())
    if (first >= field::internal)
      internal_tensors_.push_back(static_cast<int>(first - field::internal));
}

UpdateReport PointwiseMaterial::update_block(const PointBlock& block) const {
  const auto variables = static_cast<Eigen::Index>(state_fields().size() - field::internal);
  const auto step_of_point = [&](std::size_t index, PointwiseNumbers& numbers) {
    PointStep point{matrix_of(numbers.strain), block.time_step,
                    block.state[field::volume_ratio][index], matrix_of(numbers.stress),
                    Eigen::Map<VectorX>(numbers.internal, variables)};
    try {
      step(point);
    } catch (const StateError& error) {
      refuse(block, index, error.what());
    }
    Eigen::Map<Vector6>(numbers.stress) = to_vector6(point.stress);
    numbers.stored = point.stored;
    numbers.frozen = point.frozen;
    numbers.dissipated = point.dissipated;
    numbers.branch = static_cast<double>(point.branch);
    numbers.iterations = static_cast<double>(point.iterations);
    numbers.below_data = point.below_data;
    numbers.beyond_data = point.beyond_data;
  };
  using Step = decltype(step_of_point);
  PointwiseParameters parameters;
  parameters.context = &step_of_point;
  parameters.step = [](const void* context, std::size_t index, PointwiseNumbers& numbers) {
    (*static_cast<const Step*>(context))(index, numbers);
  };
  parameters.internal_variables = static_cast<int>(variables);
  parameters.tensors = internal_tensors_.data();
  parameters.tensor_count = static_cast<int>(internal_tensors_.size());
  return checked(kernels<PointwiseKernels>().update(parameters, density(), block), block);
}

}  // namespace furrow

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// NumPy arrays that show memory of a simulation without a copy.

#include <memory>
#include <vector>

#include <pybind11/numpy.h>

#include "lammps.h"

namespace furrow::coupling {

using Owner = std::shared_ptr<LAMMPS_NS::LAMMPS>;

/// A read-only array. It keeps LIGGGHTS alive, but not a memory that LIGGGHTS replaces in a step.
/// @param strides [numbers]
template <class Number>
pybind11::array view(const Owner& owner, const Number* data, std::vector<pybind11::ssize_t> shape,
                     std::vector<pybind11::ssize_t> strides) {
  namespace py = pybind11;
  for (py::ssize_t& stride : strides) stride *= static_cast<py::ssize_t>(sizeof(Number));
  const py::capsule base(new Owner(owner), [](void* held) { delete static_cast<Owner*>(held); });
  py::array_t<Number> array(std::move(shape), std::move(strides), data, base);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return std::move(array);
}

/// Array of `count` numbers.
template <class Number>
pybind11::array view(const Owner& owner, const Number* data, std::size_t count) {
  return view(owner, data, {static_cast<pybind11::ssize_t>(count)}, {1});
}

/// Rows of three numbers. @param stride from one row to the next [numbers]
template <class Number>
pybind11::array view_rows(const Owner& owner, const Number* data, std::size_t count,
                          pybind11::ssize_t stride = 3) {
  return view(owner, data, {static_cast<pybind11::ssize_t>(count), 3}, {stride, 1});
}

}  // namespace furrow::coupling

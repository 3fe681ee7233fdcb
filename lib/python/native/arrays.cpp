// Finds out how the numbers of an array lie in memory.
#include "arrays.h"

#include <stdexcept>

namespace vndf::python {

Columns::Columns(const py::array& array)
    : data_(static_cast<char*>(const_cast<void*>(array.data()))),
      in_double_(array.itemsize() == sizeof(double)) {
  if (array.dtype().kind() != 'f' || (!in_double_ && array.itemsize() != sizeof(float)))
    throw std::invalid_argument("an array must be of float32 or float64");
  const py::ssize_t last = array.ndim() - 1;
  width_ = static_cast<std::size_t>(array.shape(last));
  width_stride_ = array.strides(last);
  for (py::ssize_t a = 0; a < last; ++a) {
    const Axis axis{array.shape(a), array.strides(a)};
    size_ *= static_cast<std::size_t>(axis.length);
    if (axis.length == 1) continue;
    if (axis.stride != 0) uniform_ = false;
    if (!axes_.empty() && axes_.back().stride == axis.length * axis.stride)
      axes_.back() = {axes_.back().length * axis.length, axis.stride};
    else
      axes_.push_back(axis);
  }
  if (!axes_.empty()) step_ = axes_.back().stride;
  packed_ = width_stride_ == array.itemsize() && step_ == array.itemsize() * array.shape(last);
}

Columns Columns::written(py::array& array) {
  if (!array.writeable()) throw std::invalid_argument("the array of results is read-only");
  return Columns(array);
}

}  // namespace vndf::python

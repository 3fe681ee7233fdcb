// Calls a function of a sampler in the precision of the array that its results go to.
#pragma once

#include <utility>

#include "arrays.h"

namespace vndf::python {

/// Calls f(T()) where T is the type of the numbers of `results`.
template <class F>
void in_precision_of(const Columns& results, F f) {
  if (results.in_double())
    f(double());
  else
    f(float());
}

}  // namespace vndf::python

// The worst of each error over the configurations of a check. Checks without random numbers measure
// several errors at each configuration, independently of the others, so that threads can share
// them.
#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

#include "vndf/support/parallel.h"
#include "vndf/validate/exact/configuration.h"

namespace vndf::validate {

/// Calls `measure(c)` for each configuration c of `list`. What it returns holds a Worst for each
/// error, and its see() takes account of those of another configuration. The result does not depend
/// on the number of threads.
template <class Measure>
auto worst_over(const std::vector<Configuration>& list, const support::Workers& workers,
                Measure measure) {
  using Errors = std::invoke_result_t<Measure, const Configuration&>;
  std::vector<Errors> each(list.size());
  support::parallel_for(list.size(), workers, [&](std::size_t i) { each[i] = measure(list[i]); });
  Errors all;
  for (const Errors& errors : each) all.see(errors);
  return all;
}

}  // namespace vndf::validate

// The Pareto front of two costs, such as time and error or size and time: the points that no other
// point beats in both.
#pragma once

#include <cstddef>
#include <vector>

namespace vndf::bench {

/// Two costs, both better when smaller.
struct Costs {
  double first, second;
};

/// The indices of the points that no other point dominates, by increasing first cost. A point
/// dominates another if neither of its costs is larger and one is smaller. Equal points are all on
/// the front; a point with a cost that is not a number is never on it.
std::vector<std::size_t> pareto_front(const std::vector<Costs>& points);

}  // namespace vndf::bench

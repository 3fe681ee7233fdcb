// The points that no other beats in two costs at once: speed and accuracy, or size and speed.
#pragma once

#include <cstddef>
#include <vector>

namespace vndf::bench {

/// Two costs, both better when smaller.
struct Costs {
  double first, second;
};

/// Numbers of the points that no other point dominates, by increasing first cost. A point dominates
/// another if neither cost is larger and one is smaller; equal points are all on the front, points
/// with a cost that is no number never.
std::vector<std::size_t> pareto_front(const std::vector<Costs>& points);

}  // namespace vndf::bench

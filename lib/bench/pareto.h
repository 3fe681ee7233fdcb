// The samplers that no other beats in speed and accuracy at once.
#pragma once

#include <cstddef>
#include <vector>

namespace vndf::bench {

/// Two costs, both better when smaller.
struct Costs {
  double time, error;
};

/// Numbers of the points that no other point dominates, by increasing time. A point dominates
/// another if neither cost is larger and one is smaller; equal points are all on the front, points
/// with a cost that is no number never.
std::vector<std::size_t> pareto_front(const std::vector<Costs>& points);

}  // namespace vndf::bench

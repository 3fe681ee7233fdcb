// The Pareto front of two costs.
#include "vndf/bench/pareto.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vndf::bench {

std::vector<std::size_t> pareto_front(const std::vector<Costs>& points) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (!std::isnan(points[k].first) && !std::isnan(points[k].second)) order.push_back(k);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    const Costs &p = points[a], &q = points[b];
    return p.first != q.first ? p.first < q.first : p.second < q.second;
  });
  // In order of the first cost, a point is on the front if its second cost is less than that of all
  // points before it, or if it equals the last point of the front.
  std::vector<std::size_t> front;
  Costs last{0, std::numeric_limits<double>::infinity()};
  for (const std::size_t k : order) {
    const Costs& p = points[k];
    const bool again = !front.empty() && p.first == last.first && p.second == last.second;
    if (!(p.second < last.second) && !again) continue;
    front.push_back(k);
    last = p;
  }
  return front;
}

}  // namespace vndf::bench

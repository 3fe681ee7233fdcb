// The Pareto front of two costs.
#include "bench/pareto.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vndf::bench {

std::vector<std::size_t> pareto_front(const std::vector<Costs>& points) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (!std::isnan(points[k].time) && !std::isnan(points[k].error)) order.push_back(k);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    const Costs &p = points[a], &q = points[b];
    return p.time != q.time ? p.time < q.time : p.error < q.error;
  });
  // In order of time a point is on the front if it errs less than all before it, or is the last of
  // them once more.
  std::vector<std::size_t> front;
  Costs last{0, std::numeric_limits<double>::infinity()};
  for (const std::size_t k : order) {
    const Costs& p = points[k];
    const bool again = !front.empty() && p.time == last.time && p.error == last.error;
    if (!(p.error < last.error) && !again) continue;
    front.push_back(k);
    last = p;
  }
  return front;
}

}  // namespace vndf::bench

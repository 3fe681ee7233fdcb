// The front of two costs, against its definition applied to every pair.
#include "vndf/bench/pareto.h"

#include <algorithm>
#include <limits>
#include <random>

#include "support/catch.h"

using namespace vndf::bench;

namespace {

/// The definition: no other point is as good in both costs and better in one.
std::vector<std::size_t> by_definition(const std::vector<Costs>& points) {
  std::vector<std::size_t> front;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Costs& p = points[k];
    const auto dominates = [&p](const Costs& q) {
      return q.first <= p.first && q.second <= p.second &&
             (q.first < p.first || q.second < p.second);
    };
    if (std::ranges::none_of(points, dominates)) front.push_back(k);
  }
  return front;
}

std::vector<std::size_t> sorted(std::vector<std::size_t> list) {
  std::ranges::sort(list);
  return list;
}

}  // namespace

TEST_CASE("the front is that of the definition, ties included") {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<Costs> points(1 + random() % 12);
    // A few whole numbers make many ties.
    for (Costs& p : points) p = {double(random() % 5), double(random() % 5)};
    REQUIRE(sorted(pareto_front(points)) == by_definition(points));
  }
}

TEST_CASE("the front is listed by increasing first cost") {
  CHECK(pareto_front({{3, 1}, {1, 3}, {2, 2}, {4, 4}}) == std::vector<std::size_t>{1, 2, 0});
}

TEST_CASE("no points have no front, and a cost that is no number is not on it") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(pareto_front({}).empty());
  CHECK(pareto_front({{nan, 0}, {0, nan}, {1, 1}}) == std::vector<std::size_t>{2});
}

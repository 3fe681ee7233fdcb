// The rank correlation of two variables.
#include "vndf/validate/statistics/rank_correlation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace vndf::validate {
namespace {

/// The rank of each value, less the mean of all ranks.
std::vector<double> centred_ranks(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return values[i] < values[j]; });
  const double mean = (static_cast<double>(values.size()) - 1) / 2;
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    const double shared = static_cast<double>(first + end - 1) / 2 - mean;
    for (std::size_t k = first; k < end; ++k) ranks[order[k]] = shared;
  }
  return ranks;
}

}  // namespace

double rank_correlation(std::span<const double> a, std::span<const double> b) {
  const auto x = centred_ranks(a), y = centred_ranks(b);
  const auto sum = [](const auto& s, const auto& t) {
    return std::inner_product(s.begin(), s.end(), t.begin(), 0.0);
  };
  const double scale = std::sqrt(sum(x, x) * sum(y, y));
  return scale > 0 ? sum(x, y) / scale : 0;
}

}  // namespace vndf::validate

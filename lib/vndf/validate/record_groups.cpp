// Groups of records that are counted or judged together.
#include "vndf/validate/record_groups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace vndf::validate {
namespace {

using Key = std::array<double, 8>;

Key key_of(const Configuration& c) {
  return {c.wi.x, c.wi.y, c.wi.z, c.alpha.x, c.alpha.y, c.correlation, c.mean.x, c.mean.y};
}

/// The band of incidence, roughness and correlation that a configuration is in.
Key band_of(const Configuration& c) {
  static constexpr std::array kEnds{0.3, 10.0, 30.0, 60.0, 75.0, 85.0, 89.0, 89.9, 90.1, 100.0};
  const double incidence = static_cast<double>(
      std::lower_bound(kEnds.begin(), kEnds.end(), c.incidence()) - kEnds.begin());
  return {incidence, std::floor(std::log10(c.alpha.x)), std::floor(std::log10(c.alpha.y)),
          std::round(2 * c.correlation)};
}

/// The indices are sorted by key, which takes less memory than a map of all keys does.
template <class KeyOf>
std::vector<Indices> grouped(const Records& records, KeyOf key_of_configuration) {
  const auto key = [&](std::size_t i) {
    return key_of_configuration(records.list[i].configuration);
  };
  Indices order(records.list.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return key(i) < key(j); });
  std::vector<Indices> groups;
  for (auto first = order.begin(); first != order.end();) {
    const Key here = key(*first);
    const auto end =
        std::find_if(first, order.end(), [&](std::size_t i) { return key(i) != here; });
    groups.emplace_back(first, end);
    first = end;
  }
  return groups;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::vector<Indices> records_by_configuration(const Records& records) {
  return grouped(records, key_of);
}

std::vector<Indices> records_by_band(const Records& records) {
  return grouped(records, band_of);
}

Place middle_of(const Records& records, const Indices& group) {
  const auto of = [&](auto number) {
    std::vector<double> values;
    for (const std::size_t i : group) values.push_back(number(records.list[i].configuration));
    return median(std::move(values));
  };
  return {.theta = of([](const Configuration& c) { return c.theta(); }),
          .alpha_x = of([](const Configuration& c) { return c.alpha.x; }),
          .alpha_y = of([](const Configuration& c) { return c.alpha.y; }),
          .correlation = of([](const Configuration& c) { return c.correlation; }),
          .mean_x = of([](const Configuration& c) { return c.mean.x; }),
          .mean_y = of([](const Configuration& c) { return c.mean.y; })};
}

}  // namespace vndf::validate

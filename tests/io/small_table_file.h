// A small table file with all that the format has, for tests of damaged and forged files.
#pragma once

#include <cmath>
#include <vector>

#include "vndf/io/table_file.h"

namespace vndf::test {

inline constexpr std::size_t kSmallRows = 16, kSmallColumns = 24, kSmallNodes = 12;

/// Row i is t^(1 + i / 10) over the column coordinate t.
inline std::vector<float> small_rows() {
  std::vector<float> values;
  for (std::size_t i = 0; i < kSmallRows; ++i)
    for (std::size_t j = 0; j < kSmallColumns; ++j)
      values.push_back(
          std::pow(static_cast<float>(j) / (kSmallColumns - 1), 1 + 0.1f * static_cast<float>(i)));
  return values;
}

inline LogCurve<double> small_curve() {
  LogCurveSegment<double> segment{0, 4, Grading::low, {}};
  for (std::size_t i = 0; i < kSmallNodes; ++i)
    segment.nodes.push_back({-std::sqrt(static_cast<double>(i)), -0.1 * static_cast<double>(i)});
  return {{segment}, true};
}

inline io::TableFile small_table_file() {
  const std::vector<RowKnot> knots{{0, 0}, {0.5, 0.25}, {1, 0.5}, {1.5, 1}};
  return {share({.distribution = "test",
                 .mean_slope = 1.5,
                 .marginal = {kSmallRows, kSmallColumns, small_rows()},
                 .conditional = {kSmallRows, kSmallColumns, small_rows()},
                 .marginal_rows = knots,
                 .conditional_rows = {},
                 .marginal_map = {{0, 0.5}, {0.25, 0.5}, {1, 0.75}},
                 .log_ndf = small_curve(),
                 .log_backfacing = small_curve()}),
          {{"profile", {0, 0.5, 1, 2}, {1, 0.75, 0.5, 0}},
           "command",
           "program",
           "",
           SurfaceSlopes{{0.3, 0.1}, 0.5, {0.25, -1}}},
          {}};
}

}  // namespace vndf::test

// Tables of every kind that a sampler can meet, made of formulas, and every target for them.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <hwy/highway.h>

#include "vndf/slope_tables.h"

namespace vndf::test {

/// A table whose rows u^(1 + row / 2) are smooth in both coordinates and increase from 0 to `end`.
inline QuantileTable power_table(std::size_t rows, std::size_t columns, RowBlend blend,
                                 double end = 1, Tangents tangents = Tangents::five_points) {
  std::vector<float> values;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) {
      const double r = rows > 1 ? static_cast<double>(i) / static_cast<double>(rows - 1) : 0;
      const double t = static_cast<double>(j) / static_cast<double>(columns - 1);
      values.push_back(static_cast<float>(end * std::pow(t, 1 + r / 2)));
    }
  return {rows, columns, values, blend, tangents};
}

inline QuantileTable conditional_table(std::size_t rows, std::size_t columns, RowBlend blend) {
  return power_table(rows, columns, blend, 0.999, Tangents::five_points_even);
}

inline SlopeTables plain_tables() {
  const LogCurve<double> curve({{0, 1, Grading::none, {{0, 0}, {-1, -1}}}}, true);
  SlopeTables tables;
  tables.distribution = "cubic rows, conditional of one row";
  tables.mean_slope = 0.7;
  tables.marginal = power_table(12, 40, RowBlend::cubic);
  tables.conditional = conditional_table(1, 24, RowBlend::linear);
  tables.log_ndf = curve;
  tables.log_backfacing = curve;
  return tables;
}

inline std::vector<std::shared_ptr<const SlopeTables>> all_kinds_of_tables() {
  std::vector<std::shared_ptr<const SlopeTables>> all{share(plain_tables())};
  const auto add = [&](const std::string& name, auto change) {
    SlopeTables tables = plain_tables();
    tables.distribution = name;
    change(tables);
    all.push_back(share(tables));
  };
  add("linear rows with knots", [](SlopeTables& t) {
    t.marginal = power_table(9, 17, RowBlend::linear);
    t.conditional = conditional_table(2, 3, RowBlend::linear);
    t.marginal_rows = {{0, 0}, {0.25, 0.5}, {0.5, 0.625}, {0.875, 1}};
    t.conditional_rows = {{0, 0}, {0.75, 1}};
    t.conditional_unit = 2.5;
  });
  add("cubic conditional", [](SlopeTables& t) {
    t.conditional = conditional_table(4, 31, RowBlend::cubic);
    t.conditional_quadratic = 0.25;
  });
  add("scale that does not grow with x, slopes to infinity", [](SlopeTables& t) {
    t.conditional = power_table(1, 24, RowBlend::linear, 1, Tangents::five_points_even);
    t.conditional_quadratic = 0;
  });
  add("marginal of one row",
      [](SlopeTables& t) { t.marginal = power_table(1, 20, RowBlend::cubic); });
  add("bounded slopes", [](SlopeTables& t) { t.support = 1.75; });
  add("marginal through a map", [](SlopeTables& t) {
    t.marginal_map = {{0, 0.125}, {0.25, 0.25}, {0.375, 0.25}, {0.875, 0.25}, {1, 0.0625}};
  });
  for (const int order : {2, 16})
    add("tails of order " + std::to_string(order),
        [order](SlopeTables& t) { t.tail_order = order; });
  return all;
}

/// Runs `f` with batches on each target of this processor in turn.
inline void for_each_target(const std::function<void(const char* target)>& f) {
  for (const auto target : hwy::SupportedAndGeneratedTargets()) {
    hwy::GetChosenTarget().Update(target);
    f(hwy::TargetName(target));
  }
  hwy::GetChosenTarget().DeInit();
}

}  // namespace vndf::test

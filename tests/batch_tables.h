// Tables of every kind that a kernel can meet, made of formulas, and every target for them.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <hwy/highway.h>

#include "vndf/bake.h"
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

/// A pair whose slopes x and y are independent but for the scale of y.
inline SlopeTables separable_pair() {
  const LogCurve<double> curve({{0, 1, Grading::none, {{0, 0}, {-1, -1}}}}, true);
  SlopeTables pair;
  pair.mean_slope = 0.7;
  pair.marginal = power_table(12, 40, RowBlend::cubic);
  pair.conditional = power_table(1, 24, RowBlend::linear, 0.999, Tangents::five_points_even);
  pair.log_ndf = curve;
  pair.log_backfacing = curve;
  return pair;
}

struct NamedTables {
  std::string name;
  KernelTables tables;
};

inline std::vector<NamedTables> make_all_kinds_of_tables() {
  std::vector<NamedTables> all;
  const auto add = [&](const std::string& name, auto change) {
    SlopeTables pair = separable_pair();
    change(pair);
    constexpr double kTolerance = 1e-4;
    constexpr std::size_t kEnough = std::size_t{1} << 22;
    all.push_back({name, bake(pair, {kTolerance, kEnough})});
    // Of what does not fit the smaller layout is taken, by the root of q.
    const std::size_t less = all.back().tables.sampling_bytes() / 4 * 3;
    all.push_back({name + ", columns by the root", bake(pair, {kTolerance, less})});
  };
  add("separable", [](SlopeTables&) {});
  add("rows in slope x", [](SlopeTables& pair) {
    pair.conditional = power_table(4, 31, RowBlend::cubic, 0.999, Tangents::five_points_even);
  });
  add("a scale that does not grow with x",
      [](SlopeTables& pair) { pair.conditional_quadratic = 0; });
  add("bounded slopes", [](SlopeTables& pair) { pair.support = 1.75; });
  return all;
}

inline const std::vector<NamedTables>& all_kinds_of_tables() {
  static const std::vector<NamedTables> all = make_all_kinds_of_tables();
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

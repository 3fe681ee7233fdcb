// Fills the two tables and the two curves for a slope distribution, and measures them.
#include "precompute/build_tables.h"

#include <algorithm>
#include <atomic>
#include <boost/math/differentiation/finite_difference.hpp>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "precompute/conditional_slopes.h"
#include "precompute/measure_certificate.h"
#include "precompute/visible_slopes.h"

namespace vndf::precompute {
namespace {

constexpr std::size_t kLargestSize = 8192;
constexpr std::size_t kCurveNodes = 2048;
// The curves end where the function is lost in double precision or, for a power tail, where it has
// been a straight line for long.
constexpr double kSmallestCurveValue = 1e-300;
constexpr double kFarthestCurve = 20;
// The last row of the conditional table stands for |x| = infinity; there all limits are reached to
// one part in 1e16.
constexpr double kLargestSlope = 1e8;

double coordinate(std::size_t i, std::size_t n) {
  return static_cast<double>(i) / static_cast<double>(n - 1);
}

void fill_marginal_row(const UnitSlopes& slopes, double row, std::size_t columns, float* w) {
  const BoundedSlope<double> c = marginal_row_inverse(row);
  const VisibleSlopes visible(slopes, c);
  double a = -1;
  for (std::size_t j = 0; j < columns; ++j) {
    const double quantile = visible.quantile(marginal_column_inverse(coordinate(j, columns)), a);
    w[j] = static_cast<float>(bounded_from_asinh(quantile).sigma / c.sigma);
    if (std::isfinite(quantile)) a = quantile;
  }
}

/// False, leaving `w` alone, where no sample can land.
bool fill_conditional_row(const UnitSlopes& slopes, double row, std::size_t columns, float* w) {
  const double x = std::min(conditional_row_inverse(row).slope(), kLargestSlope);
  if (!ConditionalSlopes::reachable(slopes, x)) return false;
  const ConditionalSlopes conditional(slopes, x);
  for (std::size_t j = 0; j < columns; ++j) {
    const double y = conditional.quantile(conditional_column_inverse(coordinate(j, columns)));
    w[j] = static_cast<float>(2 * bounded_from_slope(-y).sigma);
  }
  return true;
}

/// Rows beyond the last slope that a sample can reach repeat the row before them.
void repeat_last_row(std::vector<float>& values, std::size_t columns,
                     const std::vector<char>& filled) {
  for (std::size_t i = 1; i < filled.size(); ++i)
    if (!filled[i]) {
      const auto row = values.begin() + static_cast<std::ptrdiff_t>(i * columns);
      std::copy(row - static_cast<std::ptrdiff_t>(columns), row, row);
    }
}

/// Samples log f at slopes sinh(a), from a = 0 to the end of f. `log_slope(a)` is d log f / da.
template <class F, class G>
LogCurve<double> make_curve(F f, G log_slope, const Workers& workers) {
  double end = kFarthestCurve;
  while (!(f(std::sinh(end)) > kSmallestCurveValue)) end *= 0.95;
  const double step = end / (kCurveNodes - 1);
  std::vector<LogCurveNode<double>> nodes(kCurveNodes);
  parallel_for(kCurveNodes, workers, [&](std::size_t k) {
    const double a = step * static_cast<double>(k);
    nodes[k] = {std::log(f(std::sinh(a))), log_slope(a) * step};
  });
  return {step, std::move(nodes)};
}

LogCurve<double> ndf_curve(const UnitSlopes& slopes, const Workers& workers) {
  const auto ndf = [&](double r) {
    const double square = 1 + r * r;
    return slopes.p22(r) * square * square;
  };
  // p22 has no derivative of its own; differences of order 6 leave an error near 1e-13.
  const auto log_ndf = [&](double a) { return std::log(ndf(std::abs(std::sinh(a)))); };
  const auto log_slope = [&](double a) {
    return boost::math::differentiation::finite_difference_derivative(log_ndf, a);
  };
  return make_curve(ndf, log_slope, workers);
}

LogCurve<double> backfacing_curve(const UnitSlopes& slopes, const Workers& workers) {
  const auto area = [&](double c) { return slopes.backfacing(c).value; };
  const auto log_slope = [&](double a) {  // dB = -Q dc
    return -slopes.upper_tail(std::sinh(a)).value * std::cosh(a) / area(std::sinh(a));
  };
  return make_curve(area, log_slope, workers);
}

void require_size(std::size_t rows, std::size_t columns) {
  if (rows < 2 || columns < 3 || rows > kLargestSize || columns > kLargestSize)
    throw std::invalid_argument("table size " + std::to_string(rows) + "x" +
                                std::to_string(columns) + ": from 2x3 to 8192x8192");
}

}  // namespace

BuiltTables build_tables(const SlopeDistribution& distribution, const BuildOptions& options) {
  require_size(options.rows, options.columns);
  const Workers quiet{options.threads};
  const UnitSlopes slopes(distribution, quiet);

  const std::size_t rows = options.rows, columns = options.columns;
  std::vector<float> marginal(rows * columns), conditional(rows * columns);
  std::vector<char> filled(rows, true);
  Workers workers{options.threads};
  if (options.progress)
    workers.progress = [&](std::size_t done) { options.progress(coordinate(done, 2 * rows + 1)); };
  parallel_for(2 * rows, workers, [&](std::size_t piece) {
    const std::size_t i = piece / 2;
    const double row = coordinate(i, rows);
    if (piece % 2 == 0)
      fill_marginal_row(slopes, row, columns, marginal.data() + i * columns);
    else
      filled[i] = fill_conditional_row(slopes, row, columns, conditional.data() + i * columns);
  });
  repeat_last_row(conditional, columns, filled);

  SlopeTables tables{distribution.name(),
                     slopes.mean_slope(),
                     QuantileTable(rows, columns, marginal),
                     QuantileTable(rows, columns, conditional),
                     ndf_curve(slopes, quiet),
                     backfacing_curve(slopes, quiet)};
  BuiltTables built{share(std::move(tables)), {}, slopes.mass(), slopes.quadrature_error()};
  built.certificate = measure_certificate(slopes, built.tables, quiet);
  return built;
}

}  // namespace vndf::precompute

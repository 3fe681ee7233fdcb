// Fills the two tables and the two curves for a slope distribution, and measures them.
#include "precompute/build_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "precompute/conditional_slopes.h"
#include "precompute/make_curve.h"
#include "precompute/measure_certificate.h"
#include "precompute/place_rows.h"
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
// A tail M ~ x^-kappa is stored at an order n with n kappa at least this: values then go to 0 no
// faster than the fifth power of the column.
constexpr double kSlowestDecay = 0.3;
constexpr int kLargestOrder = 16;

constexpr double kSmallestMass = 1e-60;
constexpr double kFarthestStep = 1e-3;

using Probabilities = std::vector<Probability<double>>;

double coordinate(std::size_t i, std::size_t n) {
  return static_cast<double>(i) / static_cast<double>(n - 1);
}

int tail_order(const UnitSlopes& slopes) {
  int order = 1;
  while (order < kLargestOrder && order * slopes.tail_exponent() < kSlowestDecay) order *= 2;
  return order;
}

BoundedSlope<double> ordered(double a, int order) {
  return bounded_from_asinh(a / order);  // tau^(1/n) = exp(a / n)
}

std::vector<double> marginal_values(const UnitSlopes& slopes, int order, double base,
                                    const Probabilities& u) {
  const VisibleSlopes visible(slopes, marginal_base_inverse(base));
  const double farthest = bounded_from_asinh(visible.farthest()).sigma;
  std::vector<double> values;
  double a = -1;
  for (const auto& p : u) {
    const double quantile = visible.quantile(p, a);
    values.push_back(ordered(quantile, order).sigma / farthest);
    if (std::isfinite(quantile)) a = quantile;
  }
  return values;
}

/// Empty where no sample can land.
std::vector<double> conditional_values(const UnitSlopes& slopes, double base,
                                       const Probabilities& p) {
  const double x = std::min(conditional_base_inverse(base).slope(), kLargestSlope);
  if (!ConditionalSlopes::reachable(slopes, x)) return {};
  const ConditionalSlopes conditional(slopes, x);
  std::vector<double> values;
  for (const auto& at : p)
    values.push_back(conditional_value(bounded_from_slope(conditional.quantile(at))));
  return values;
}

RowSource marginal_source(const UnitSlopes& slopes, int order) {
  RowSource source{[&slopes, order](double base, const Probabilities& u) {
                     return marginal_values(slopes, order, base, u);
                   },
                   marginal_column_inverse<double>};
  for (const double r : slopes.distribution().breaks())
    source.breaks.push_back(marginal_base(bounded_from_slope(r / slopes.mean_slope())));
  std::sort(source.breaks.begin(), source.breaks.end());
  return source;
}

/// asinh of the slope beyond which the partial moment, and with it the visible mass at any
/// incidence, is below any probability in a table; infinite for power tails.
double farthest_sampled(const UnitSlopes& slopes) {
  if (std::isfinite(slopes.support())) return std::asinh(slopes.support());
  if (std::isfinite(slopes.tail_exponent())) return std::numeric_limits<double>::infinity();
  double a = 0;
  while (slopes.m(a) > kSmallestMass) a += kFarthestStep;
  return a;
}

RowSource conditional_source(const UnitSlopes& slopes) {
  RowSource source{[&slopes](double base, const Probabilities& p) {
                     return conditional_values(slopes, base, p);
                   },
                   conditional_column_inverse<double>};
  source.end = conditional_base(bounded_from_asinh(farthest_sampled(slopes)));
  for (const double r : slopes.distribution().breaks()) {
    const double base = conditional_base(bounded_from_slope(r / slopes.mean_slope()));
    if (base < source.end) source.breaks.push_back(base);
  }
  return source;
}

/// Values, row-major, of a table that is being filled.
struct Filling {
  const RowSource& source;
  RowAxis<double> axis;
  std::size_t rows, columns;
  Probabilities u = {};
  std::vector<float> values = {};
  std::vector<char> filled = {};

  Filling(const RowSource& from, const std::vector<RowKnot>& knots, const BuildOptions& options)
      : source(from), axis(knots), rows(options.rows), columns(options.columns) {
    for (std::size_t j = 0; j < columns; ++j)
      u.push_back(source.column_inverse(coordinate(j, columns)));
    values.resize(rows * columns);
    filled.resize(rows);
  }

  void fill_row(std::size_t i) {
    const auto row = source.row(axis.base(coordinate(i, rows)), u);
    filled[i] = !row.empty();
    const auto to = values.begin() + static_cast<std::ptrdiff_t>(i * columns);
    std::transform(row.begin(), row.end(), to, [](double v) { return static_cast<float>(v); });
    // Neighbours may lie closer than root finding tells apart.
    std::partial_sum(to, to + static_cast<std::ptrdiff_t>(row.size()), to,
                     [](float below, float v) { return std::max(below, v); });
  }

  /// Rows beyond the last slope that a sample can reach repeat the row before them.
  QuantileTable table() {
    for (std::size_t i = 1; i < rows; ++i)
      if (!filled[i]) {
        const auto row = values.begin() + static_cast<std::ptrdiff_t>(i * columns);
        std::copy(row - static_cast<std::ptrdiff_t>(columns), row, row);
      }
    return {rows, columns, values};
  }
};

/// Samples log f(slope) to the end of f.
template <class F>
LogCurve<double> curve_of(const UnitSlopes& slopes, F f, const Workers& workers) {
  double end = kFarthestCurve;
  while (!(f(std::sinh(end)) > kSmallestCurveValue) && end > 1e-3) end *= 0.95;
  const bool open = std::isinf(slopes.support());
  const auto ends = segment_ends(slopes.distribution(), slopes.mean_slope(), end);
  return make_curve([&](double a) { return std::log(f(std::sinh(a))); }, ends,
                    {.nodes = kCurveNodes, .open = open, .cusp = true}, workers);
}

LogCurve<double> ndf_curve(const UnitSlopes& slopes, const Workers& workers) {
  // A singular centre is approached, not reached.
  constexpr double kCentre = 1e-12;
  const auto ndf = [&](double r) {
    const double square = 1 + r * r;
    return slopes.p22(std::max(r, kCentre)) * square * square;
  };
  return curve_of(slopes, ndf, workers);
}

LogCurve<double> backfacing_curve(const UnitSlopes& slopes, const Workers& workers) {
  return curve_of(
      slopes, [&](double c) { return slopes.backfacing(c).value; }, workers);
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

  const int order = tail_order(slopes);
  const RowSource marginal_rows = marginal_source(slopes, order);
  const RowSource conditional_rows = conditional_source(slopes);
  const auto marginal_knots = place_rows(marginal_rows, options.rows, quiet);
  const auto conditional_knots = place_rows(conditional_rows, options.rows, quiet);
  Filling marginal(marginal_rows, marginal_knots, options);
  Filling conditional(conditional_rows, conditional_knots, options);

  const std::size_t pieces = 2 * options.rows;
  Workers workers{options.threads};
  if (options.progress)
    workers.progress = [&](std::size_t done) { options.progress(coordinate(done, pieces + 1)); };
  parallel_for(pieces, workers, [&](std::size_t piece) {
    (piece % 2 == 0 ? marginal : conditional).fill_row(piece / 2);
  });

  SlopeTables tables{.distribution = distribution.name(),
                     .mean_slope = slopes.mean_slope(),
                     .support = slopes.support(),
                     .tail_order = order,
                     .marginal = marginal.table(),
                     .conditional = conditional.table(),
                     .marginal_rows = marginal_knots,
                     .conditional_rows = conditional_knots,
                     .log_ndf = ndf_curve(slopes, quiet),
                     .log_backfacing = backfacing_curve(slopes, quiet)};
  BuiltTables built{share(std::move(tables)), {}, slopes.mass(), slopes.quadrature_error()};
  built.certificate = measure_certificate(slopes, built.tables, quiet);
  return built;
}

}  // namespace vndf::precompute

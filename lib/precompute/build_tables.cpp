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
#include "precompute/marginal_map.h"
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

// A marginal table with a larger fault than this is made again with a map, and the better one kept.
constexpr double kGoodFault = 2e-6;
// What a tail at 1e-6 that is off by a factor counts against an error in u: 5 % as much as 5e-6.
constexpr double kTailWeight = 1e-4;
constexpr std::size_t kMapNodesPerColumn = 4;

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

/// How the quantiles of a marginal table are kept.
struct MarginalCoding {
  int order;
  std::vector<MonotoneNode> nodes = {};
  MonotoneMap<double> map = MonotoneMap<double>(nodes);

  /// Value of the slope sinh(a) in a row that ends at sinh(farthest).
  double value(double a, double farthest) const {
    const double sigma = ordered(a, order).sigma;
    return map.identity() ? sigma / bounded_from_asinh(farthest).sigma : map.inverse(sigma);
  }
};

std::vector<double> marginal_values(const UnitSlopes& slopes, const MarginalCoding& coding,
                                    double base, const Probabilities& u) {
  const VisibleSlopes visible(slopes, marginal_base_inverse(base));
  std::vector<double> values;
  double a = -1;
  for (const auto& p : u) {
    const double quantile = visible.quantile(p, a);
    values.push_back(coding.value(quantile, visible.farthest()));
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

RowSource marginal_source(const UnitSlopes& slopes, const MarginalCoding& coding) {
  RowSource source{[&slopes, &coding](double base, const Probabilities& u) {
                     return marginal_values(slopes, coding, base, u);
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

/// A table with the knots of its rows.
struct PlacedTable {
  QuantileTable table;
  std::vector<RowKnot> knots;
};

/// Rows, as floats, of a table that is being filled; empty ones where no sample lands.
using Rows = std::vector<std::vector<float>>;

std::vector<float> rounded(const std::vector<double>& row) {
  std::vector<float> values(row.size());
  std::transform(row.begin(), row.end(), values.begin(),
                 [](double v) { return static_cast<float>(v); });
  // Neighbours may lie closer than root finding tells apart.
  std::partial_sum(values.begin(), values.end(), values.begin(),
                   [](float below, float v) { return std::max(below, v); });
  return values;
}

/// Rows beyond the last slope that a sample can reach repeat the row before them.
QuantileTable joined(const Rows& rows, std::size_t columns) {
  std::vector<float> values;
  values.reserve(rows.size() * columns);
  const std::vector<float>* last = &rows.front();
  for (const auto& row : rows) {
    if (!row.empty()) last = &row;
    values.insert(values.end(), last->begin(), last->end());
  }
  return {rows.size(), columns, values};
}

PlacedTable fill(const RowSource& source, const BuildOptions& options, const Workers& workers) {
  const auto knots = place_rows(source, options.rows, {workers.threads});
  const RowAxis<double> axis(knots);
  Probabilities u;
  for (std::size_t j = 0; j < options.columns; ++j)
    u.push_back(source.column_inverse(coordinate(j, options.columns)));
  Rows rows(options.rows);
  parallel_for(rows.size(), workers, [&](std::size_t i) {
    rows[i] = rounded(source.row(axis.base(coordinate(i, options.rows)), u));
  });
  return {joined(rows, options.columns), knots};
}

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

/// Workers that report the part of the work from `begin` to `end`, both fractions of the whole.
Workers reporting(const BuildOptions& options, double begin, double end) {
  Workers workers{options.threads};
  if (options.progress)
    workers.progress = [&options, begin, end](std::size_t done) {
      const double part = static_cast<double>(done) / static_cast<double>(options.rows);
      options.progress(begin + (end - begin) * part);
    };
  return workers;
}

void set_marginal(SlopeTables& tables, const UnitSlopes& slopes, const MarginalCoding& coding,
                  const BuildOptions& options, const Workers& workers) {
  auto [table, knots] = fill(marginal_source(slopes, coding), options, workers);
  tables.tail_order = coding.order;
  tables.marginal = std::move(table);
  tables.marginal_rows = std::move(knots);
  tables.marginal_map = coding.nodes;
}

/// One figure for how bad a table is: its largest error in u or, where it is worse, its tails.
double fault(const TableErrors& e) {
  const double tail = std::max(std::abs(std::log(e.lower.e6)), std::abs(std::log(e.upper.e6)));
  return std::max(e.max_u_error, kTailWeight * tail);
}

/// The same tables with a map, if that makes the marginal better.
void try_map(BuiltTables& built, const UnitSlopes& slopes, const BuildOptions& options) {
  const int order = built.tables->tail_order;
  const MarginalCoding coding{order,
                              marginal_map(slopes, order, kMapNodesPerColumn * options.columns)};
  SlopeTables tables = *built.tables;
  const Workers workers{options.threads};
  set_marginal(tables, slopes, coding, options, workers);
  const auto mapped = share(std::move(tables));
  const Certificate certificate = measure_certificate(slopes, mapped, workers);
  if (fault(certificate.marginal) >= fault(built.certificate.marginal)) return;
  built.tables = mapped;
  built.certificate = certificate;
}

}  // namespace

BuiltTables build_tables(const SlopeDistribution& distribution, const BuildOptions& options) {
  require_size(options.rows, options.columns);
  const Workers workers{options.threads};
  const UnitSlopes slopes(distribution, workers);

  SlopeTables tables{.distribution = distribution.name(),
                     .mean_slope = slopes.mean_slope(),
                     .support = slopes.support(),
                     .log_ndf = ndf_curve(slopes, workers),
                     .log_backfacing = backfacing_curve(slopes, workers)};
  set_marginal(tables, slopes, {tail_order(slopes)}, options, reporting(options, 0, 0.5));
  auto [table, knots] = fill(conditional_source(slopes), options, reporting(options, 0.5, 1));
  tables.conditional = std::move(table);
  tables.conditional_rows = std::move(knots);

  BuiltTables built{share(std::move(tables)), {}, slopes.mass(), slopes.quadrature_error()};
  built.certificate = measure_certificate(slopes, built.tables, workers);
  if (fault(built.certificate.marginal) > kGoodFault) try_map(built, slopes, options);
  return built;
}

}  // namespace vndf::precompute

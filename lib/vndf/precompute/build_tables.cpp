// Runs the steps of the builder one after another.
#include "vndf/precompute/build_tables.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "vndf/precompute/conditional_shape.h"
#include "vndf/precompute/make_curve.h"
#include "vndf/precompute/marginal_map.h"
#include "vndf/precompute/measure_certificate.h"
#include "vndf/precompute/rows.h"

namespace vndf::precompute {
namespace {

constexpr std::size_t kLargestSize = 8192;
constexpr std::size_t kCurveNodes = 2048;
// The curves end where the function is nearly lost in double precision or, for a power tail, at a
// slope of sinh(20) = 2.4e8, where it is a straight line to rounding. Where D = p22 (1 + r^2)^2 is
// above 1e-250, p22 is still a normal number at the farthest place, so that the tangents which
// continue the curve keep all their digits.
constexpr double kSmallestCurveValue = 1e-250;
constexpr double kFarthestCurve = 20;

/// Returns asinh of the last slope at which `f` is above kSmallestCurveValue. It may be 0 in a hole
/// too, so the search comes from beyond.
template <class F>
double end_of(F f) {
  constexpr double kStep = 0.95, kNearest = 1e-3;
  constexpr int kHalvings = 30;
  const auto positive = [&](double a) { return f(std::sinh(a)) > kSmallestCurveValue; };
  double end = kFarthestCurve, beyond = end;
  while (!positive(end) && end > kNearest) {
    beyond = end;
    end *= kStep;
  }
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = (end + beyond) / 2;
    (positive(middle) ? end : beyond) = middle;
  }
  return end;
}

/// Samples log f(slope) up to the end of f.
template <class F>
LogCurve<double> curve_of(const UnitSlopes& slopes, F f, const support::Workers& workers) {
  const double end = end_of(f);
  const bool open = std::isinf(slopes.support());
  const auto ends = segment_ends(slopes.distribution(), slopes.mean_slope(), end);
  return make_curve([&](double a) { return std::log(f(std::sinh(a))); }, ends,
                    {.nodes = kCurveNodes, .open = open, .cusp = true}, workers);
}

LogCurve<double> ndf_curve(const UnitSlopes& slopes, const support::Workers& workers) {
  // The first node of a pole takes the value at the middle of the first cell. Cubics overshoot the
  // logarithm of a pole, and the more the nearer to it they begin.
  constexpr double kCentre = kPoleSegment / (2.0 * kCurveNodes * kCurveNodes);
  const auto ndf = [&](double r) {
    const double square = 1 + r * r;
    return slopes.p22(std::max(r, kCentre)) * square * square;
  };
  return curve_of(slopes, ndf, workers);
}

LogCurve<double> backfacing_curve(const UnitSlopes& slopes, const support::Workers& workers) {
  return curve_of(
      slopes, [&](double c) { return slopes.backfacing(c).value; }, workers);
}

void require_size(const TableLayout& layout) {
  if (layout.rows < 2 || layout.columns < kFewestColumns || layout.rows > kLargestSize ||
      layout.columns > kLargestSize)
    throw std::invalid_argument("table size " + std::to_string(layout.rows) + "x" +
                                std::to_string(layout.columns) + ": from 2x5 to 8192x8192");
}

/// Workers that tell the caller of build_tables() which fraction of the rows is done.
support::Workers reporting(const BuildOptions& options) {
  support::Workers workers{options.threads};
  if (options.progress)
    workers.progress = [&options](std::size_t done, std::size_t count) {
      options.progress(static_cast<double>(done) / static_cast<double>(count));
    };
  return workers;
}

void set_marginal(SlopeTables& tables, const UnitSlopes& slopes, const TableLayout& layout,
                  const support::Workers& workers) {
  tables.marginal_map = marginal_map(slopes);
  const MonotoneMap map(tables.marginal_map);
  PlacedTable placed =
      fill_table(marginal_rows(slopes, map), marginal_rows_below(slopes, map), layout, workers);
  tables.marginal = std::move(placed.table);
  tables.marginal_rows = std::move(placed.knots);
}

void set_conditional(SlopeTables& tables, const UnitSlopes& slopes, const TableLayout& layout,
                     const support::Workers& workers) {
  const auto [scale, factorises] = conditional_shape(slopes);
  const RowSource source = conditional_rows(slopes, scale);
  tables.conditional_constant = scale.constant;
  tables.conditional_quadratic = scale.quadratic;
  PlacedTable placed = factorises ? PlacedTable{fill_with_one_row(source, layout)}
                                  : fill_table(source, layout, workers);
  tables.conditional = std::move(placed.table);
  tables.conditional_rows = std::move(placed.knots);
}

}  // namespace

BuiltTables build_tables(const distributions::SlopeDistribution& distribution,
                         const BuildOptions& options) {
  require_size(options.layout);
  const support::Workers workers{options.threads};
  const UnitSlopes slopes(distribution, workers);
  SlopeTables tables{.distribution = distribution.name(),
                     .mean_slope = slopes.mean_slope(),
                     .support = slopes.support(),
                     .log_ndf = ndf_curve(slopes, workers),
                     .log_backfacing = backfacing_curve(slopes, workers)};
  const support::Workers rows = reporting(options);
  set_marginal(tables, slopes, options.layout, part_of(rows, 0, 2));
  set_conditional(tables, slopes, options.layout, part_of(rows, 1, 2));
  if (options.progress) options.progress(1);

  const auto shared = share(std::move(tables));
  return {shared, measure_certificate(slopes, shared, workers), slopes.mass(),
          slopes.quadrature_error()};
}

}  // namespace vndf::precompute

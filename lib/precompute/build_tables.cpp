// Fills the two tables and the two curves for a slope distribution, and measures them.
#include "precompute/build_tables.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "precompute/conditional_shape.h"
#include "precompute/make_curve.h"
#include "precompute/marginal_map.h"
#include "precompute/measure_certificate.h"
#include "precompute/quantile_rows.h"

namespace vndf::precompute {
namespace {

constexpr std::size_t kLargestSize = 8192;
constexpr std::size_t kCurveNodes = 2048;
// The curves end where the function is nearly lost in double precision or, for a power tail, where
// it has been a straight line for long. Of D = p22 (1 + r^2)^2 >= 1e-250 the factor p22 keeps all
// its digits to the farthest place, and so do the tangents that continue the curve.
constexpr double kSmallestCurveValue = 1e-250;
constexpr double kFarthestCurve = 20;
// A marginal table with a larger fault than this is made again with a map, and the better one kept.
constexpr double kGoodFault = 3e-6;
// What a tail at 1e-6 that is off by a factor counts against an error in u: 5 % as much as 5e-6.
constexpr double kTailWeight = 1e-4;
constexpr std::size_t kMapNodesPerColumn = 4;

/// asinh of the last slope at which `f` is more than nothing. It may be nothing in a hole too, so
/// the end is looked for from beyond.
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

/// Samples log f(slope) to the end of f.
template <class F>
LogCurve<double> curve_of(const UnitSlopes& slopes, F f, const Workers& workers) {
  const double end = end_of(f);
  const bool open = std::isinf(slopes.support());
  const auto ends = segment_ends(slopes.distribution(), slopes.mean_slope(), end);
  return make_curve([&](double a) { return std::log(f(std::sinh(a))); }, ends,
                    {.nodes = kCurveNodes, .open = open, .cusp = true}, workers);
}

LogCurve<double> ndf_curve(const UnitSlopes& slopes, const Workers& workers) {
  // A pole is approached, not reached: to the middle of the first cell, for cubics overshoot the
  // logarithm of a pole, the more the nearer they begin.
  constexpr double kCentre = kPoleSegment / (2.0 * kCurveNodes * kCurveNodes);
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

void require_size(const TableLayout& layout) {
  const std::size_t least = layout.blend == RowBlend::cubic ? 4 : 2;
  if (layout.rows < least || layout.columns < 3 || layout.rows > kLargestSize ||
      layout.columns > kLargestSize)
    throw std::invalid_argument("table size " + std::to_string(layout.rows) + "x" +
                                std::to_string(layout.columns) + ": from " + std::to_string(least) +
                                "x3 to 8192x8192");
}

/// Workers that report rows as a part of the work of both tables, the first `before` rows done.
Workers reporting(const BuildOptions& options, std::size_t before) {
  Workers workers{options.threads};
  if (options.progress)
    workers.progress = [&options, before](std::size_t done) {
      const double rows = 2 * static_cast<double>(options.layout.rows);
      options.progress(static_cast<double>(before + done) / rows);
    };
  return workers;
}

/// The same tables with a map, if that makes the marginal better.
void try_map(BuiltTables& built, const UnitSlopes& slopes, const BuildOptions& options) {
  SlopeTables tables = *built.tables;
  const Workers workers{options.threads};
  set_mapped_marginal(tables, slopes, options.layout, kMapNodesPerColumn * options.layout.columns,
                      workers);
  const auto mapped = share(std::move(tables));
  const Certificate certificate = measure_certificate(slopes, mapped, workers);
  if (fault(certificate.marginal) >= fault(built.certificate.marginal)) return;
  built.tables = mapped;
  built.certificate = certificate;
}

void set_marginal(SlopeTables& tables, const UnitSlopes& slopes, const MarginalCoding& coding,
                  const TableLayout& layout, const Workers& workers) {
  PlacedTable placed = fill_table(marginal_rows(slopes, coding), layout, workers);
  tables.tail_order = coding.order;
  tables.marginal = std::move(placed.table);
  tables.marginal_rows = std::move(placed.knots);
  tables.marginal_map = coding.nodes;
}

}  // namespace

double fault(const TableErrors& e) {
  const double tail = std::max(std::abs(std::log(e.lower.e6)), std::abs(std::log(e.upper.e6)));
  return std::max(e.max_u_error, kTailWeight * tail);
}

SlopeTables tables_without_rows(const UnitSlopes& slopes, const Workers& workers) {
  return {.distribution = slopes.distribution().name(),
          .mean_slope = slopes.mean_slope(),
          .support = slopes.support(),
          .log_ndf = ndf_curve(slopes, workers),
          .log_backfacing = backfacing_curve(slopes, workers)};
}

void set_plain_marginal(SlopeTables& tables, const UnitSlopes& slopes, const TableLayout& layout,
                        const Workers& workers) {
  set_marginal(tables, slopes, {tail_order(slopes)}, layout, workers);
}

void set_mapped_marginal(SlopeTables& tables, const UnitSlopes& slopes, const TableLayout& layout,
                         std::size_t nodes, const Workers& workers) {
  const int order = tail_order(slopes);
  set_marginal(tables, slopes, {order, marginal_map(slopes, order, nodes)}, layout, workers);
}

void set_conditional(SlopeTables& tables, const UnitSlopes& slopes, const ConditionalShape& shape,
                     double unit, TableLayout layout, const Workers& workers) {
  if (shape.factorises) layout.rows = 1;
  const ConditionalCoding coding{shape.scale, unit};
  PlacedTable placed = fill_table(conditional_rows(slopes, coding), layout, workers);
  tables.conditional = std::move(placed.table);
  tables.conditional_rows = std::move(placed.knots);
  tables.conditional_constant = shape.scale.constant;
  tables.conditional_quadratic = shape.scale.quadratic;
  tables.conditional_unit = unit;
}

BuiltTables build_tables(const SlopeDistribution& distribution, const BuildOptions& options) {
  require_size(options.layout);
  const Workers workers{options.threads};
  const UnitSlopes slopes(distribution, workers);
  SlopeTables tables = tables_without_rows(slopes, workers);
  set_plain_marginal(tables, slopes, options.layout, reporting(options, 0));
  set_conditional(tables, slopes, conditional_shape(slopes), 1, options.layout,
                  reporting(options, options.layout.rows));

  if (options.progress) options.progress(1);

  BuiltTables built{share(std::move(tables)), {}, slopes.mass(), slopes.quadrature_error()};
  built.certificate = measure_certificate(slopes, built.tables, workers);
  const bool cubic = options.layout.blend == RowBlend::cubic;
  if (cubic || fault(built.certificate.marginal) > kGoodFault) try_map(built, slopes, options);
  return built;
}

}  // namespace vndf::precompute

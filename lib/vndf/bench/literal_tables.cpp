// Fills and measures the literal tables.
#include "vndf/bench/literal_tables.h"

#include <algorithm>
#include <cmath>

#include "vndf/precompute/conditional_distribution.h"
#include "vndf/precompute/map_errors.h"
#include "vndf/precompute/marginal_distribution.h"
#include "vndf/support/low_discrepancy.h"

namespace vndf::bench {

using precompute::ConditionalDistribution;
using precompute::density_error;
using precompute::from_complement;
using precompute::from_tail;
using precompute::keep_farthest;
using precompute::MarginalDistribution;
using precompute::tail_ratio;
using precompute::u_error;
using precompute::UnitSlopes;
using support::parallel_for;
using support::Workers;

namespace {

constexpr double kRightAngle = std::numbers::pi / 2;
constexpr std::size_t kRows = 200;       // quasi-random rows at which a table is measured
constexpr std::size_t kUniform = 256;    // u uniform
constexpr std::size_t kEdgeColumns = 3;  // first and last cells, each at kPerCell places
constexpr std::size_t kPerCell = 16;
constexpr double kDensityEnd = 1e-6, kTail = 1e-6;
constexpr double kFarthestRatio = 4e5;  // of the mass of that tail

/// u of column j, or the last that has a slope.
Probability<double> column_u(std::size_t j, std::size_t side) {
  const double u = static_cast<double>(j) / static_cast<double>(side - 1);
  if (u < kLiteralEnd) return from_tail(kLiteralEnd);
  if (u > 1 - kLiteralEnd) return from_complement(kLiteralEnd);
  return from_tail(u);
}

MarginalDistribution visible_at(const UnitSlopes& slopes, double theta) {
  const double z = theta < kRightAngle ? std::cos(theta) : 0;
  return {slopes, bounded_cotangent(z, slopes.mean_slope() * std::sin(theta))};
}

/// The distribution of y in units of the mean slope, at the slope x in those units.
ConditionalDistribution conditional_at(const UnitSlopes& slopes, double x) {
  return {slopes, x, precompute::plain_scale(slopes)};
}

/// The scale of that distribution.
double scale_at(const UnitSlopes& slopes, double x) {
  return precompute::plain_scale(slopes).at({x, 1});
}

void fill_x_row(const UnitSlopes& slopes, double theta, std::size_t side, float* row) {
  const MarginalDistribution visible = visible_at(slopes, theta);
  double a = 0;
  for (std::size_t j = 0; j < side; ++j) {
    a = visible.quantile(column_u(j, side), a);
    row[j] = static_cast<float>(std::sinh(a) * slopes.mean_slope());
  }
}

void fill_y_row(const UnitSlopes& slopes, double x, std::size_t side, float* row) {
  const ConditionalDistribution conditional = conditional_at(slopes, x);
  const double scale = scale_at(slopes, x) * slopes.mean_slope();
  for (std::size_t j = 0; j < side; ++j) {
    const auto folded = fold(column_u(j, side));
    row[j] = static_cast<float>(folded.sign * scale * conditional.quantile(folded.p));
  }
}

/// |x| of row i in units of the mean slope; infinite at both ends.
double row_slope(const UnitSlopes& slopes, std::size_t i, std::size_t side) {
  const double angle = 2 * static_cast<double>(i) / static_cast<double>(side - 1) - 1;
  return std::abs(angle) < 1 ? std::abs(std::tan(kRightAngle * angle)) / slopes.mean_slope()
                             : std::numeric_limits<double>::infinity();
}

/// Rows are symmetric in x. Those of x <= 0 come first, the last of them being the nearest to 0.
void fill_y(const UnitSlopes& slopes, LiteralTables& tables, const support::Workers& workers) {
  const std::size_t side = tables.side, half = (side + 1) / 2;
  const auto reached = [&](std::size_t i) {
    const double x = row_slope(slopes, i, side);
    return std::isfinite(x) && ConditionalDistribution::reachable(slopes, x);
  };
  std::size_t first = 0;
  while (first + 1 < half && !reached(first)) ++first;
  const auto row = [&](std::size_t i) { return tables.y.data() + i * side; };
  support::parallel_for(half - first, workers, [&](std::size_t k) {
    fill_y_row(slopes, reached(first + k) ? row_slope(slopes, first + k, side) : 0, side,
               row(first + k));
  });
  for (std::size_t i = 0; i < first; ++i) std::copy_n(row(first), side, row(i));
  for (std::size_t i = half; i < side; ++i) std::copy_n(row(side - 1 - i), side, row(i));
}

// Measuring.

std::vector<Probability<double>> probabilities(std::size_t side, double shift) {
  std::vector<Probability<double>> list;
  for (std::size_t k = 0; k < kUniform; ++k) list.push_back(from_tail(support::golden(k, shift)));
  for (std::size_t k = 0; k < kPerCell * kEdgeColumns; ++k) {
    const double e = (static_cast<double>(k) + 0.5) / kPerCell / static_cast<double>(side - 1);
    list.push_back(from_tail(e));
    list.push_back(from_complement(e));
  }
  precompute::add_tails(list);
  return list;
}

/// The errors of one row, whose `distribution` maps u to the CDF of the slope sampled there.
template <class Distribution>
LiteralErrors measure_row(const Distribution& distribution, std::size_t index, std::size_t side) {
  LiteralErrors errors;
  for (const auto& u : probabilities(side, support::golden(index, 0.25))) {
    errors.max_u_error = std::max(errors.max_u_error, std::abs(u_error(distribution(u), u)));
    if (std::min(u.u, u.complement) >= kDensityEnd)
      errors.max_density_error = std::max(errors.max_density_error, density_error(distribution, u));
  }
  const auto keep_tail = [&](auto mass) {
    keep_farthest(errors.tail_ratio, tail_ratio(mass, kTail, kFarthestRatio));
  };
  keep_tail([&](double e) { return distribution(from_tail(e)).u; });
  keep_tail([&](double e) { return distribution(from_complement(e)).complement; });
  return errors;
}

LiteralErrors combine(const std::vector<LiteralErrors>& rows) {
  LiteralErrors all;
  for (const LiteralErrors& r : rows) {
    all.max_u_error = std::max(all.max_u_error, r.max_u_error);
    all.max_density_error = std::max(all.max_density_error, r.max_density_error);
    keep_farthest(all.tail_ratio, r.tail_ratio);
  }
  return all;
}

}  // namespace

std::shared_ptr<const LiteralTables> make_literal_tables(const UnitSlopes& slopes, std::size_t side,
                                                         const support::Workers& workers) {
  auto tables = std::make_shared<LiteralTables>();
  tables->side = side;
  tables->x.resize(side * side);
  tables->y.resize(side * side);
  support::parallel_for(side, workers, [&](std::size_t i) {
    const double theta = kRightAngle * static_cast<double>(i) / static_cast<double>(side - 1);
    fill_x_row(slopes, theta, side, tables->x.data() + i * side);
  });
  fill_y(slopes, *tables, workers);
  return tables;
}

LiteralErrors measure_literal(const UnitSlopes& slopes,
                              const std::shared_ptr<const LiteralTables>& tables,
                              const support::Workers& workers) {
  const LiteralSampler<double> sampler(tables);
  const std::vector<double> places = precompute::off_grid_rows(tables->side, kRows);
  std::vector<LiteralErrors> rows(places.size());
  support::parallel_for(rows.size(), workers, [&](std::size_t i) {
    const double theta = places[i] * kRightAngle;
    const MarginalDistribution visible = visible_at(slopes, theta);
    const auto distribution = [&](const Probability<double>& u) {
      const double x = sampler.sample_x(theta, u.u) / slopes.mean_slope();
      return visible.cdf(std::min(std::asinh(x), visible.farthest()));
    };
    rows[i] = measure_row(distribution, i, tables->side);
  });
  return combine(rows);
}

}  // namespace vndf::bench

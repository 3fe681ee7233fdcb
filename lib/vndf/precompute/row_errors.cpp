// Measures one row of a sampler's map against the exact distribution.
#include "vndf/precompute/row_errors.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "vndf/precompute/conditional_distribution.h"
#include "vndf/precompute/map_errors.h"
#include "vndf/support/low_discrepancy.h"

namespace vndf::precompute {
namespace {

constexpr std::size_t kUniform = 192;    // places uniform in u, for the mean
constexpr std::size_t kColumns = 384;    // places uniform over the columns, for the maximum
constexpr std::size_t kEdgeColumns = 3;  // first and last cells, each at four places
constexpr double kDensityEnd = 1e-6;     // the density is measured between this and 1 - this
constexpr double kSmallestTail = 1e-9;   // the partial moment beyond a slope x that is measured

template <class Mass>
TailRatios tail_ratios(Mass mass) {
  return {tail_ratio(mass, 1e-4, kFarthestRatio), tail_ratio(mass, 1e-5, kFarthestRatio),
          tail_ratio(mass, 1e-6, kFarthestRatio)};
}

void keep_farthest_of_each(TailRatios& ratios, const TailRatios& candidate) {
  keep_farthest(ratios.e4, candidate.e4);
  keep_farthest(ratios.e5, candidate.e5);
  keep_farthest(ratios.e6, candidate.e6);
}

/// Returns the places in (0, 1) at which one row is measured beside those uniform in u.
std::vector<Probability<double>> hard_probabilities(const RowPlaces& row, double shift) {
  std::vector<Probability<double>> places;
  for (std::size_t k = 0; k < kColumns; ++k)
    places.push_back(row.column_inverse(support::golden(k, shift)));
  for (std::size_t k = 0; k < 4 * kEdgeColumns; ++k) {
    const double t = (static_cast<double>(k) / 4 + 0.125) / static_cast<double>(row.columns - 1);
    places.push_back(row.column_inverse(t));
    places.push_back(row.column_inverse(1 - t));
  }
  add_tails(places);
  places.insert(places.end(), row.edges.begin(), row.edges.end());
  return places;
}

TableErrors combine(const std::vector<TableErrors>& rows) {
  TableErrors all;
  for (const TableErrors& r : rows) {
    if (r.max_u_error > all.max_u_error) {
      all.max_u_error = r.max_u_error;
      all.worst_row = r.worst_row;
      all.worst_u = r.worst_u;
    }
    all.mean_u_error += r.mean_u_error / static_cast<double>(rows.size());
    all.max_density_error = std::max(all.max_density_error, r.max_density_error);
    keep_farthest_of_each(all.lower, r.lower);
    keep_farthest_of_each(all.upper, r.upper);
  }
  return all;
}

}  // namespace

Probability<double> conditional_u2(double t) {
  const bool lower = t < 0.5;
  const double half = conditional_column_inverse(lower ? 1 - 2 * t : 2 * t - 1).complement / 2;
  return lower ? from_tail(half) : from_complement(half);
}

TableErrors measure_row(const RowMap& map, const RowPlaces& places, std::size_t index) {
  TableErrors errors;
  const auto measure = [&](const Probability<double>& exact_u) {
    const Probability<double> u = map.given(exact_u);
    const double error = error_or_largest(std::abs(u_error(map.cdf(u), u)));
    if (error > errors.max_u_error) {
      errors.max_u_error = error;
      errors.worst_row = places.row;
      errors.worst_u = exact_u.u;
    }
    const auto smooth = [&](const Probability<double>& p) { return map.smooth_cdf(p, exact_u); };
    if (std::min(exact_u.u, exact_u.complement) >= kDensityEnd)
      errors.max_density_error =
          std::max(errors.max_density_error, error_or_largest(density_error(smooth, exact_u)));
    return error;
  };
  const double shift = support::golden(index, 0.25);
  for (std::size_t k = 0; k < kUniform; ++k)
    errors.mean_u_error += measure(from_tail(support::golden(k, shift))) / kUniform;
  for (const auto& u : hard_probabilities(places, shift)) measure(u);
  errors.lower = tail_ratios([&](double e) { return map.tail_cdf(from_tail(e)).u; });
  errors.upper = tail_ratios([&](double e) { return map.tail_cdf(from_complement(e)).complement; });
  return errors;
}

TableErrors measure_rows(std::size_t count, const support::Workers& workers,
                         const std::function<TableErrors(std::size_t)>& row) {
  std::vector<TableErrors> errors(count);
  support::parallel_for(count, workers, [&](std::size_t i) { errors[i] = row(i); });
  return combine(errors);
}

bool measures_below(const UnitSlopes& slopes, const BoundedSlope<double>& c) {
  const double k = -c.slope();
  return k < slopes.support() && slopes.backfacing(k).value >= kLeastArea * std::hypot(1, k);
}

bool measures_conditional(const UnitSlopes& slopes, double x, float sigma) {
  if (sigma == 0.5f && std::isinf(slopes.p22(0))) return false;
  // Single precision may round a slope next to the largest one to beyond it.
  const double rounded = bounded_from_sigma<double>(sigma).slope();
  return slopes.m(std::asinh(x)) > kSmallestTail &&
         ConditionalDistribution::reachable(slopes, std::max(x, rounded));
}

}  // namespace vndf::precompute

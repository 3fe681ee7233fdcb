// The u-error as a picture.
#include "vndf/validate/pictures/u_error_map.h"

#include <cmath>

#include "vndf/precompute/map_errors.h"
#include "vndf/validate/checks/map_row.h"

namespace vndf::validate {
namespace {

/// `count` >= 2 numbers from `low` to `high`, equally far apart.
std::vector<double> equidistant(double low, double high, std::size_t count) {
  std::vector<double> list(count);
  for (std::size_t k = 0; k < count; ++k)
    list[k] = low + (high - low) * (static_cast<double>(k) / static_cast<double>(count - 1));
  return list;
}

}  // namespace

std::vector<double> logit_places(std::size_t count) {
  const double end = std::log((1 - kSmallestShownU) / kSmallestShownU);
  std::vector<double> list = equidistant(-end, end, count);
  for (double& v : list) v = to_single(1 / (1 + std::exp(-v)));
  return list;
}

UErrorMap marginal_error_map(const SamplerUnderTest& sampler, std::size_t rows, std::size_t columns,
                             const support::Workers& workers) {
  UErrorMap map{equidistant(0, 90, rows), logit_places(columns), Grid(columns, rows, kUnknown)};
  support::parallel_for(rows, workers, [&](std::size_t j) {
    const Configuration c = at_angles(map.row[j], 0, 1, 1);
    if (!sampler.claims.inverse_at(c)) return;
    const MapRow row(sampler, c);
    for (std::size_t i = 0; i < columns; ++i) {
      const StretchedSlope s = row.slope(map.u[i], 0.5);
      if (MapRow::carried(s))
        map.error.at(i, j) =
            std::abs(precompute::u_error(row.marginal_cdf(s), precompute::from_tail(map.u[i])));
    }
  });
  return map;
}

UErrorMap conditional_error_map(const SamplerUnderTest& sampler, double theta, std::size_t rows,
                                std::size_t columns, const support::Workers& workers) {
  UErrorMap map{logit_places(rows), logit_places(columns), Grid(columns, rows, kUnknown)};
  const Configuration c = at_angles(theta, 0, 1, 1);
  if (!sampler.claims.inverse_at(c)) return map;
  const MapRow row(sampler, c);
  support::parallel_for(rows, workers, [&](std::size_t j) {
    const auto conditional = row.conditional(map.row[j]);
    if (!conditional) return;
    for (std::size_t i = 0; i < columns; ++i) {
      const StretchedSlope s = row.slope(map.row[j], map.u[i]);
      if (MapRow::carried(s)) map.error.at(i, j) = conditional->error(s.y / s.w, map.u[i]);
    }
  });
  return map;
}

}  // namespace vndf::validate

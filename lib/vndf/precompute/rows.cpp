// Computes rows of the two tables by inverting their distributions column by column.
#include "vndf/precompute/rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vndf/precompute/asinh_slope.h"
#include "vndf/precompute/conditional_distribution.h"
#include "vndf/precompute/marginal_distribution.h"

namespace vndf::precompute {
namespace {

// The last row of the conditional table stands for |x| = infinity or for the largest slope R, where
// the conditional is a limit. At this slope a power tail has reached its limit to one part in 1e16,
// and at this part of R a compact distribution has to 1e-8. Nearer to R, r = sqrt(x^2 + y^2) would
// be rounded beyond it.
constexpr double kLargestSlope = 1e8;
constexpr double kInsideSupport = 1 - 1e-8;
// No sample lands where less than this is left of the partial moment, so the rows of the
// conditional table end there: random numbers in double precision end at 1e-16.
constexpr double kNoMass = 1e-60;
constexpr double kFarthestStep = 1e-3;  // of the search for that place, in asinh
// From directions below the horizon of which less than this part of the surface is visible, the
// marginal table has no rows of their own: it is a tenth of the smallest part for which errors are
// measured.
constexpr double kNoArea = 1e-13;
constexpr double kFarthestBelow = 40;  // asinh of a slope at which kNoArea is passed by all tails

using Probabilities = std::vector<Probability<double>>;

std::vector<double> marginal_values(const UnitSlopes& slopes, const MonotoneMap& map, double base,
                                    const Probabilities& u) {
  const BoundedSlope<double> c = marginal_base_inverse(base);
  const MarginalDistribution visible(slopes, c);
  const double scale = marginal_scale(c);
  std::vector<double> values;
  double a = -1;
  for (const auto& p : u) {
    const double quantile = visible.quantile(p, a);
    values.push_back(map.inverse(bounded_from_asinh(quantile).sigma / scale));
    if (std::isfinite(quantile)) a = quantile;
  }
  return values;
}

/// Empty where no sample can land.
std::vector<double> conditional_values(const UnitSlopes& slopes,
                                       const ConditionalScale<double>& scale, double base,
                                       const Probabilities& p) {
  const double largest = std::min(kLargestSlope, slopes.support() * kInsideSupport);
  const double x = std::min(conditional_base_inverse(base), largest);
  if (!ConditionalDistribution::reachable(slopes, x)) return {};
  const ConditionalDistribution conditional(slopes, x, scale);
  std::vector<double> values;
  for (const auto& at : p)
    values.push_back(conditional_value(bounded_from_slope(conditional.quantile(at))));
  return values;
}

/// Returns asinh of the slope beyond which no sample lands. It is infinite for power tails, whose
/// conditionals have a limit.
double farthest_sampled(const UnitSlopes& slopes) {
  if (std::isfinite(slopes.support())) return std::asinh(slopes.support());
  if (std::isfinite(slopes.tail_exponent())) return std::numeric_limits<double>::infinity();
  double a = 0;
  while (slopes.m(a) > kNoMass) a += kFarthestStep;
  return a;
}

/// Returns asinh(|c|) of the lowest direction for which the marginal table has a row.
double lowest_direction(const UnitSlopes& slopes) {
  const auto visible = [&](double a) {
    return slopes.backfacing(std::sinh(a)).value / std::cosh(a) > kNoArea;
  };
  double low = 0, high = std::min(kFarthestBelow, std::asinh(slopes.support()));
  while (high - low > kFarthestStep) {
    const double middle = (low + high) / 2;
    (visible(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace

RowSource marginal_rows(const UnitSlopes& slopes, const MonotoneMap& map) {
  RowSource source{[&slopes, &map](double base, const Probabilities& u) {
                     return marginal_values(slopes, map, base, u);
                   },
                   marginal_column_inverse<double>};
  for (const double r : slopes.distribution().breaks())
    source.breaks.push_back(marginal_base(bounded_from_slope(r / slopes.mean_slope())));
  std::sort(source.breaks.begin(), source.breaks.end());
  return source;
}

RowSource marginal_rows_below(const UnitSlopes& slopes, const MonotoneMap& map) {
  RowSource source{[&slopes, &map](double base, const Probabilities& u) {
                     return marginal_values(slopes, map, 1 + base, u);
                   },
                   marginal_column_inverse<double>};
  source.end = marginal_base(mirrored(bounded_from_asinh(lowest_direction(slopes)))) - 1;
  for (const double r : slopes.distribution().breaks()) {
    const double base = marginal_base(bounded_from_slope(-r / slopes.mean_slope())) - 1;
    if (base < source.end) source.breaks.push_back(base);
  }
  std::sort(source.breaks.begin(), source.breaks.end());
  return source;
}

RowSource conditional_rows(const UnitSlopes& slopes, const ConditionalScale<double>& scale) {
  RowSource source{[&slopes, &scale](double base, const Probabilities& p) {
                     return conditional_values(slopes, scale, base, p);
                   },
                   conditional_column_inverse<double>};
  source.end = conditional_base(bounded_from_asinh(farthest_sampled(slopes)));
  for (const double r : slopes.distribution().breaks()) {
    const double base = conditional_base(bounded_from_slope(r / slopes.mean_slope()));
    if (base < source.end) source.breaks.push_back(base);
  }
  return source;
}

}  // namespace vndf::precompute

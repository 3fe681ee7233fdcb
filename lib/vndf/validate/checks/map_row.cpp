// One row of the map of a sampler under test.
#include "vndf/validate/checks/map_row.h"

#include <algorithm>
#include <cmath>

#include "vndf/precompute/map_errors.h"
#include "vndf/validate/statistics/density_distance.h"

namespace vndf::validate {

using precompute::from_tail;
using precompute::u_error;

bool RoundedConditional::is_checked(const precompute::UnitSlopes& slopes, double x) {
  return ExactConditional::is_checked(slopes, x * (1 + kSlopeRounding));
}

RoundedConditional::RoundedConditional(const precompute::UnitSlopes& slopes, double x)
    : conditionals_{ExactConditional(slopes, x), ExactConditional(slopes, x * (1 - kSlopeRounding)),
                    ExactConditional(slopes, x * (1 + kSlopeRounding))} {}

/// The distance from 0 of the interval of errors that the CDFs near `y` give.
template <class F>
double RoundedConditional::least(double y, F error_of) const {
  double low = error_of(conditionals_[0].cdf(y)), high = low;
  for (const ExactConditional& conditional : conditionals_)
    for (const double s : {1 - kSlopeRounding, 1 + kSlopeRounding}) {
      const double e = error_of(conditional.cdf(y * s));
      if (std::isnan(e)) return kUnknown;
      low = std::min(low, e);
      high = std::max(high, e);
    }
  return std::max({0.0, low, -high});
}

double RoundedConditional::error(double y, double u) const {
  return least(y, [u](const Probability<double>& cdf) { return u_error(cdf, from_tail(u)); });
}

double RoundedConditional::ratio_error(double y, double u, double mass) const {
  return least(y, [u, mass](const Probability<double>& cdf) {
    return (u < 0.5 ? cdf.u : cdf.complement) / mass - 1;
  });
}

MapRow::MapRow(const SamplerUnderTest& sampler, const Configuration& configuration)
    : sampler_(sampler),
      configuration_(configuration),
      frame_(*sampler.exact, configuration),
      visible_(sampler.exact->unit_slopes(), frame_.cotangent()) {}

StretchedSlope MapRow::slope(double u1, double u2) const {
  return frame_.slope_of(sampler_.sample_one(configuration_, u1, u2));
}

Probability<double> MapRow::marginal_cdf(const StretchedSlope& s) const {
  const double a = s.x == 0 ? 0 : std::asinh(s.x / std::max(s.w, kSmallestHeight));
  return visible_.cdf(std::min(a, visible_.farthest()));
}

std::optional<RoundedConditional> MapRow::conditional(double u1) const {
  const auto& slopes = sampler_.exact->unit_slopes();
  const StretchedSlope middle = slope(u1, 0.5);
  const double x = middle.x / middle.w;
  if (!carried(middle) || !RoundedConditional::is_checked(slopes, x)) return {};
  return RoundedConditional(slopes, x);
}

}  // namespace vndf::validate

// One row of a map under judgement.
#include "vndf/validate/checks/map_row.h"

#include <algorithm>
#include <cmath>

#include "vndf/precompute/map_errors.h"
#include "vndf/validate/statistics/density_distance.h"

namespace vndf::validate {

using precompute::from_tail;
using precompute::u_error;

bool RoundedConditional::judged(const precompute::UnitSlopes& slopes, double x) {
  return ConditionalLaw::judged(slopes, x * (1 + kSlopeRounding));
}

RoundedConditional::RoundedConditional(const precompute::UnitSlopes& slopes, double x)
    : laws_{ConditionalLaw(slopes, x), ConditionalLaw(slopes, x * (1 - kSlopeRounding)),
            ConditionalLaw(slopes, x * (1 + kSlopeRounding))} {}

/// Distance from 0 of the interval of errors that the CDFs at `y` give.
template <class F>
double RoundedConditional::least(double y, F error_of) const {
  double low = error_of(laws_[0].cdf(y)), high = low;
  for (const ConditionalLaw& law : laws_)
    for (const double s : {1 - kSlopeRounding, 1 + kSlopeRounding}) {
      const double e = error_of(law.cdf(y * s));
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

MapRow::MapRow(const Subject& subject, const Configuration& configuration)
    : subject_(subject),
      configuration_(configuration),
      frame_(*subject.law, configuration),
      visible_(subject.law->slopes(), frame_.cotangent()) {}

StretchedSlope MapRow::slope(double u1, double u2) const {
  return frame_.slope_of(subject_.sample_one(configuration_, u1, u2));
}

Probability<double> MapRow::marginal_cdf(const StretchedSlope& s) const {
  const double a = s.x == 0 ? 0 : std::asinh(s.x / std::max(s.w, kSmallestHeight));
  return visible_.cdf(std::min(a, visible_.farthest()));
}

std::optional<RoundedConditional> MapRow::conditional(double u1) const {
  const auto& slopes = subject_.law->slopes();
  const StretchedSlope middle = slope(u1, 0.5);
  const double x = middle.x / middle.w;
  if (!carried(middle) || !RoundedConditional::judged(slopes, x)) return {};
  return RoundedConditional(slopes, x);
}

}  // namespace vndf::validate

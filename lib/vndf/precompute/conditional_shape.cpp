// Compares the conditionals at several slopes x.
#include "vndf/precompute/conditional_shape.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "vndf/precompute/conditional_distribution.h"

namespace vndf::precompute {
namespace {

constexpr double kPlaces[] = {0.25, 1,
                              3};   // slopes x whose conditionals are compared with that at 0
constexpr int kProbabilities = 24;  // columns at which they are compared

/// Returns the width of the conditional at x, which is its mass over its density at y = 0.
double width(const UnitSlopes& slopes, double x) {
  return slopes.density(x).value / slopes.p22(x);
}

/// Returns B with width(x)^2 = width(0)^2 (1 + B x^2) at every place, if there is one.
std::optional<double> quadratic_growth(const UnitSlopes& slopes) {
  constexpr double kSame = 1e-8;
  const double at_zero = width(slopes, 0);
  if (!(at_zero > 0) || !std::isfinite(at_zero)) return {};
  const auto growth = [&](double x) {
    const double ratio = width(slopes, x) / at_zero;
    return (ratio * ratio - 1) / (x * x);
  };
  const double b = growth(1);
  for (const double x : kPlaces)
    if (!(std::abs(growth(x) - b) * x * x <= kSame * (1 + b * x * x))) return {};
  return std::max(0.0, b < kSame ? 0.0 : b);
}

std::vector<double> values_at(const UnitSlopes& slopes, double x,
                              const ConditionalScale<double>& scale) {
  const ConditionalDistribution conditional(slopes, x, scale);
  std::vector<double> values;
  for (int k = 1; k < kProbabilities; ++k) {
    const auto p = conditional_column_inverse(static_cast<double>(k) / kProbabilities);
    values.push_back(conditional_value(bounded_from_slope(conditional.quantile(p))));
  }
  return values;
}

bool same_everywhere(const UnitSlopes& slopes, const ConditionalScale<double>& scale) {
  const auto at_zero = values_at(slopes, 0, scale);
  for (const double place : kPlaces) {
    const double r = slopes.support(), x = std::isfinite(r) ? r * place / (1 + place) : place;
    if (!ConditionalDistribution::reachable(slopes, x)) return false;
    const auto there = values_at(slopes, x, scale);
    for (std::size_t k = 0; k < there.size(); ++k)
      if (!(std::abs(there[k] - at_zero[k]) <= kSameConditional)) return false;
  }
  return true;
}

}  // namespace

ConditionalShape conditional_shape(const UnitSlopes& slopes) {
  ConditionalShape shape{plain_scale(slopes)};
  // A break makes a kink in y that moves with x. The end of a compact distribution is none, because
  // it is the scale itself.
  const bool bounded = std::isfinite(slopes.support());
  if (slopes.distribution().breaks().size() > (bounded ? 1 : 0)) return shape;
  const auto growth = bounded ? shape.scale.quadratic : quadratic_growth(slopes);
  if (!growth || !ConditionalDistribution::reachable(slopes, 0) || !std::isfinite(slopes.p22(0)))
    return shape;
  const ConditionalScale<double> scale{shape.scale.constant, *growth};
  if (same_everywhere(slopes, scale)) shape = {scale, true};
  return shape;
}

}  // namespace vndf::precompute

// The map through which the values of a marginal table go where sigma_n(x) / sigma(c) does not fit
// the distribution: its own quantile function, on the axis of the columns. A slope quantile has a
// corner wherever the density P of the slopes changes abruptly, as between the two scales of a
// mixture or at the edge of a ring; seen through the map the quantiles of all angles are smooth.
#pragma once

#include <cstddef>
#include <vector>

#include "precompute/unit_slopes.h"
#include "vndf/monotone_map.h"

namespace vndf::precompute {

/// s -> sigma_n of the slope whose base probability has the column s, n = `order`, with `nodes` >=
/// 3. The base density is P(x) / sigma(x), up to a factor: its lower tail is that of the slopes
/// visible at any oblique angle, |x| P(x), and its upper tail is that at normal incidence, P(x).
std::vector<CubicNode<double>> marginal_map(const UnitSlopes& slopes, int order, std::size_t nodes);

}  // namespace vndf::precompute

// The map through which the values of a marginal table go: the quantile function of the
// distribution itself, on the axis of the columns. A slope quantile has a corner wherever the
// density P of the slopes changes abruptly, as between the two scales of a mixture or at the edge
// of a ring; seen through the map the quantiles of all angles are smooth.
#pragma once

#include <cstddef>
#include <vector>

#include "vndf/monotone_map.h"
#include "vndf/precompute/unit_slopes.h"

namespace vndf::precompute {

/// Cubics of the map. Smooth distributions are content with 256; so many take a mixture at 1:100
/// from 3e-4 to 1e-5 and a ring from 2e-5 to 1.5e-6, and more gain nothing. A power of two, for the
/// place in its cell is then exact in single precision.
inline constexpr std::size_t kMapPieces = 4096;

/// s -> sigma of the slope whose base probability has the column s, by `pieces` >= 2 cubics. The
/// base density is P(x) / sigma(x), up to a factor: its lower tail is that of the slopes visible at
/// any oblique angle, |x| P(x), and its upper tail is that at normal incidence, P(x).
std::vector<CubicNode<double>> marginal_map(const UnitSlopes& slopes,
                                            std::size_t pieces = kMapPieces);

}  // namespace vndf::precompute

// The map through which the values of a marginal table go: the quantile function of the slopes
// themselves, over the same columns. A quantile function has a corner wherever the density P of the
// slopes changes abruptly, as between the two scales of a mixture or at the edge of a ring. The
// corner moves with the angle of incidence, but seen through the map the quantiles of all angles
// are smooth, so that linear rows and cubic columns follow them.
#pragma once

#include <cstddef>
#include <vector>

#include "vndf/monotone_map.h"
#include "vndf/precompute/unit_slopes.h"

namespace vndf::precompute {

/// Cubics of the map. 256 are enough for smooth distributions. 4096 bring the u-error of a mixture
/// at 1:100 from 3e-4 to 1e-5 and that of a ring from 2e-5 to 1.5e-6; more gain nothing. The number
/// is a power of two because the place within a cubic is then exact in single precision.
inline constexpr std::size_t kMapPieces = 4096;

/// Returns the nodes of s -> sigma of the slope whose base probability has the column s, for
/// `pieces` >= 2 cubics. The base density is P(x) / sigma(x), up to a factor, because its tails are
/// those of visible slopes: |x| P(x) below, as at any oblique angle, and P(x) above, as at normal
/// incidence.
std::vector<CubicNode<double>> marginal_map(const UnitSlopes& slopes,
                                            std::size_t pieces = kMapPieces);

}  // namespace vndf::precompute

// Samples the logarithm of a positive function of a slope into a LogCurve. Power tails and
// exponential ones are smooth in the logarithm, so a few thousand nodes keep a relative precision
// near rounding from the centre to the farthest slopes.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "vndf/distributions/slope_distribution.h"
#include "vndf/log_curve.h"
#include "vndf/support/parallel.h"

namespace vndf::precompute {

/// Where the segment of a pole at slope 0 ends, in asinh(slope / mean_slope). Nodes crowd at the
/// beginning of a segment in proportion to its length, so that among n of them the first lies at
/// 0.01 / n^2 and the pole is followed from there on.
inline constexpr double kPoleSegment = 0.01;

/// Returns the ends of the segments of the curves of a distribution, in asinh(slope / mean_slope):
/// 0, the end of a pole there, the breaks of p22 and, unless slopes are bounded, `end`.
std::vector<double> segment_ends(const distributions::SlopeDistribution& d, double mean_slope,
                                 double end);

struct CurveOptions {
  /// Nodes of each segment.
  std::size_t nodes = 2048;
  /// Whether the function goes on beyond the last end.
  bool open = true;
  /// Whether the function may have a cusp at slope 0.
  bool cusp = false;
};

/// Samples log f, given as a function of a = asinh(slope), in segments between consecutive `ends`.
/// Tangents are differences of the values of order 4, so that the relative error between n nodes is
/// some n^-4. Where f is 0 or infinite at an end, the value is clamped to a finite one.
LogCurve<double> make_curve(const std::function<double(double a)>& log_f,
                            const std::vector<double>& ends, const CurveOptions& options,
                            const support::Workers& workers);

}  // namespace vndf::precompute

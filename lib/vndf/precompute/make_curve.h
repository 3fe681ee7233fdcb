// Samples the logarithm of a positive function of a slope into a LogCurve.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "vndf/distributions/slope_distribution.h"
#include "vndf/log_curve.h"
#include "vndf/support/parallel.h"

namespace vndf::precompute {

/// Where the segment of a pole ends, in asinh(slope / mean_slope). Nodes crowd at the beginning of
/// a segment in proportion to its length: among n of them a pole is followed from 0.01 / n^2 on.
inline constexpr double kPoleSegment = 0.01;

/// Ends of the segments of the curves of a distribution in asinh(slope / mean_slope): 0, that of a
/// pole there, its breaks, and `end` unless it is bounded.
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

/// The curve through log f, given as a function of a = asinh(slope), in segments between
/// consecutive `ends`. The tangents are differences of the values, of order 4: between n nodes the
/// relative error is some n^-4. Where f is 0 or singular at an end, the value stays finite.
LogCurve<double> make_curve(const std::function<double(double a)>& log_f,
                            const std::vector<double>& ends, const CurveOptions& options,
                            const support::Workers& workers);

}  // namespace vndf::precompute

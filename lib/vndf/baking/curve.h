// Bakes a positive function of one slope, D or the area of back-facing facets. The kernel keeps its
// logarithm to base 2 in cells of cubics, because the function falls over many powers of two, and
// segment by segment, because it may jump or have a kink between two of them.
#pragma once

#include <functional>

#include "vndf/baking/block.h"
#include "vndf/log_curve.h"

namespace vndf::baking {

/// Where a segment begins and ends, in units of U.
struct CurveSpan {
  double begin, end;
};

/// The spans of the segments of `curve` where U is `unit` mean slopes and `log2` is the logarithm
/// over slopes in units of U. The last span of an open curve goes on until the function has fallen
/// to nothing in single precision, or to kVndfFarthest.
std::vector<CurveSpan> spans_of(const LogCurve<double>& curve, double unit,
                                const std::function<double(double)>& log2);

/// Puts the cells, guides and segments of exp2(log2(x)) over `spans`, and returns where they are.
/// The largest relative error is `tolerance` where the function is above 2^-126.
kernel::VndfCurve put_curve(KernelBlock& block, const std::vector<CurveSpan>& spans,
                            const std::function<double(double)>& log2, double tolerance);

}  // namespace vndf::baking

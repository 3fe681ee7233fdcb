// Bakes a positive function of one slope, D or the back-facing area: its logarithm to base 2 in
// cells of cubics, segment by segment between the places at which it may jump or have a kink.
#pragma once

#include <functional>

#include "vndf/baking/block.h"
#include "vndf/log_curve.h"

namespace vndf::baking {

/// A segment from `begin` to `end`, in units of U.
struct CurveSpan {
  double begin, end;
};

/// The spans of the segments of `curve`, whose logarithm in units of `unit` is `log2`; an open one
/// goes on until that has fallen to nothing, or to kVndfFarthest.
std::vector<CurveSpan> spans_of(const LogCurve<double>& curve, double unit,
                                const std::function<double(double)>& log2);

/// Writes the cells, guides and segments of exp2(log2(x)) over `spans`, to the relative error
/// `tolerance` where it is above 2^-126.
kernel::VndfCurve put_curve(KernelBlock& block, const std::vector<CurveSpan>& spans,
                            const std::function<double(double)>& log2, double tolerance);

}  // namespace vndf::baking

// Every tolerance of the tests, with where it comes from. A bound that a docstring promises is the
// library's own constant and is not repeated here.
#pragma once

#include <cstddef>

namespace vndf::test {

/// Table entries: root finding to 1e-12 in u (issue of record: build_tables.h and
/// marginal_distribution.h).
inline constexpr double kQuantileError = 1e-12;

/// The 1024 x 1024 tables, in single precision: the bound on u-error that the README promises. The
/// worst measured is 5e-7: half from interpolation between rows, half from rounding.
inline constexpr double kLargeTableUError = 2e-6;

/// The same for the 1024 x 1024 tables of any family, but those that the README lists as missing
/// it.
inline constexpr double kFamilyUError = 5e-6;

/// Tail mass ratios of the 1024 x 1024 tables at 1e-6 and 1e-5: the README's promise.
inline constexpr double kTailRatioAt1e6 = 0.05, kTailRatioAt1e5 = 0.01;

/// Relative error of D, G1 and pdf in single precision. A relative rounding of asinh(slope), and
/// twice one of its root, the coordinate of the curve, count 160 times in D of Beckmann at the
/// largest radius: 2 r^2 = 55 times asinh(slope) = 2.9. The largest seen at 2e6 radii is 4.1e-5.
inline constexpr double kFunctionError = 5e-5;

/// The same in double precision: the interpolation of the curves, in whose graded coordinate the
/// logarithm of a Beckmann density falls as fast as the eighth power.
inline constexpr double kFunctionErrorInDouble = 1e-8;

/// Quadrature against closed forms, relative (slope_integrals.h).
inline constexpr double kIntegralError = 1e-12;

/// Chi-square: the probability that a correct sampler fails a test of the quick suite, whose seeds
/// are fixed.
inline constexpr double kSignificance = 1e-6;

}  // namespace vndf::test

// A profile of many samples, or of noisy ones, as a profile of few. The work of a build grows with
// the samples of a profile and the file of tables carries them all, so a long profile is replaced
// by the curve that fits it best. A curve of fewer pieces averages noise, too.
//
// The curve is a cubic spline of log p22 over log(1 + r^2 / s^2), fitted by least squares. Its
// pieces are halved, those with the largest errors first, so that they are short where the profile
// bends.
#pragma once

#include <cstddef>

#include "vndf/distributions/radial_profile.h"

namespace vndf::distributions {

/// A profile of at most this many samples is kept as it is. A build of 1024 x 1024 tables then
/// takes at most twice as long as that of a distribution whose integrals are known: each sample
/// adds 10 ms to some 2.5 s. Maps have up to 210.
inline constexpr std::size_t kMostProfileSamples = 256;

/// Largest error in u of the visible slopes for 10000 noiseless samples of a smooth distribution.
inline constexpr double kResamplingUError = 1e-6;

/// How far the fitted curve is from the samples that it replaces.
struct FitResidual {
  std::size_t samples = 0;  ///< as many as were given
  /// Largest difference between the CDFs of the slope radius, of all slopes or of slopes weighted
  /// by their length, which is what counts at grazing incidence.
  double u_error = 0;
  /// Root mean square of the relative differences of p22, in which samples count in proportion to
  /// their share of the mass.
  double density = 0;
};

struct FittedProfile {
  RadialProfile profile;
  FitResidual residual;
};

/// Returns the best fit with kMostProfileSamples at most. The samples keep the rules of
/// checked_profile(). Zeros at the ends stay as they are.
FittedProfile resampled(const RadialProfile& profile);

/// Fewest samples of positive density that can be smoothed: either half of them determines a cubic.
inline constexpr std::size_t kFewestToSmooth = 8;

/// Returns the fit that predicts best what it has not seen: pieces are halved as long as the fit to
/// every other sample comes nearer to the rest. What is left is taken for noise. Throws
/// std::invalid_argument as checked_profile() does, and for fewer than kFewestToSmooth positive
/// samples.
FittedProfile smoothed(RadialProfile profile);

}  // namespace vndf::distributions

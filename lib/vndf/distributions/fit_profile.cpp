// Fits splines with more and more pieces.
#include "vndf/distributions/fit_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "vndf/distributions/least_squares_spline.h"

namespace vndf::distributions {
namespace {

// A piece has at least two samples, which with its neighbours determine it. Where either half of
// the samples is fitted, it has at least twice as many.
constexpr std::size_t kFewestInPiece = 2, kFewestInHalvedPiece = 4;
// Samples weigh as much as their share of the mass, because errors count in u; and this share
// belongs to all of them alike, because a sample must not count for nothing.
constexpr double kEqualShare = 0.01;
// In each round the pieces are halved that have at least this part of the largest error. A cubic of
// half the length has a sum of squared errors that is 2^9 times smaller, so that the rest can wait.
constexpr double kLargeError = 0.01;
// A fit is exact where the root mean square of its relative errors is below this.
constexpr double kExact = 1e-8;
// The spline through the fitted samples differs from the fit at its ends. With this many samples
// that no longer matters.
constexpr std::size_t kFewestFitted = 32;
// A zero at either end is kept beside the fitted samples.
constexpr std::size_t kMostFitted = kMostProfileSamples - 2;

/// The positive samples of a profile, each with the logarithm of its density.
struct Samples {
  std::vector<double> r, t, value, weight;

  std::size_t size() const { return r.size(); }
  WeightedSamples weighted() const { return {t, value, weight}; }
};

/// What samples hold of the integrals of r^power p22.
std::vector<double> shares(const std::vector<double>& r, const std::vector<double>& density,
                           int power) {
  std::vector<double> share(r.size());
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double before = r[i == 0 ? 0 : i - 1], after = r[std::min(i + 1, r.size() - 1)];
    share[i] = std::pow(r[i], power) * density[i] * (after - before);
  }
  const double sum = std::accumulate(share.begin(), share.end(), 0.0);
  for (double& s : share) s /= sum;
  return share;
}

Samples positive_samples(const RadialProfile& profile) {
  const ProfileCoordinate coordinate(profile);
  Samples samples;
  std::vector<double> density;
  for (std::size_t i = 0; i < profile.r.size(); ++i) {
    if (profile.p22[i] == 0) continue;
    samples.r.push_back(profile.r[i]);
    samples.t.push_back(coordinate(profile.r[i]));
    samples.value.push_back(std::log(profile.p22[i]));
    density.push_back(profile.p22[i]);
  }
  const auto upright = shares(samples.r, density, 1), grazing = shares(samples.r, density, 2);
  const auto n = static_cast<double>(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples.weight.push_back((1 - kEqualShare) * (upright[i] + grazing[i]) / 2 + kEqualShare / n);
  return samples;
}

/// The samples at which pieces begin and end, increasing.
using Knots = std::vector<std::size_t>;

std::vector<double> places(const Samples& samples, const Knots& knots) {
  std::vector<double> t;
  for (const std::size_t k : knots) t.push_back(samples.t[k]);
  return t;
}

/// The weighted sums of squared errors of each piece.
std::vector<double> errors_of(const LeastSquaresSpline& fit, const Samples& samples,
                              const Knots& knots) {
  std::vector<double> errors(knots.size() - 1, 0);
  for (std::size_t piece = 0; piece < errors.size(); ++piece)
    for (std::size_t i = knots[piece]; i < knots[piece + 1]; ++i) {
      const double error = fit.at(samples.t[i]) - samples.value[i];
      errors[piece] += samples.weight[i] * error * error;
    }
  return errors;
}

/// Returns `knots` with the worst pieces halved into pieces of at least `fewest` samples. They are
/// the same if no piece can be halved or if the fit is exact.
Knots halved(Knots knots, const std::vector<double>& errors, std::size_t fewest) {
  std::vector<std::size_t> pieces;
  for (std::size_t piece = 0; piece < errors.size(); ++piece)
    if (knots[piece + 1] - knots[piece] >= 2 * fewest) pieces.push_back(piece);
  std::ranges::stable_sort(pieces, std::greater<>(), [&](std::size_t p) { return errors[p]; });
  const double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
  if (pieces.empty() || !(sum > kExact * kExact)) return knots;
  const double large = kLargeError * errors[pieces.front()];
  for (const std::size_t piece : pieces) {
    if (knots.size() == kMostFitted || errors[piece] < large) break;
    knots.push_back((knots[piece] + knots[piece + 1]) / 2);
  }
  std::sort(knots.begin(), knots.end());
  return knots;
}

/// Every second sample, from the first or from the second.
Samples half_of(const Samples& samples, std::size_t first) {
  Samples half;
  for (std::size_t i = first; i < samples.size(); i += 2) {
    half.r.push_back(samples.r[i]);
    half.t.push_back(samples.t[i]);
    half.value.push_back(samples.value[i]);
    half.weight.push_back(samples.weight[i]);
  }
  return half;
}

/// The weighted sum of squared differences of either half of the samples from the fit to the other.
double prediction_error(const std::array<Samples, 2>& halves, const std::vector<double>& knots) {
  double sum = 0;
  for (const std::size_t fitted : {0u, 1u}) {
    const LeastSquaresSpline fit(halves[fitted].weighted(), knots);
    const Samples& other = halves[1 - fitted];
    for (std::size_t i = 0; i < other.size(); ++i) {
      const double error = fit.at(other.t[i]) - other.value[i];
      sum += other.weight[i] * error * error;
    }
  }
  return sum;
}

Knots closest_knots(const Samples& samples) {
  Knots knots{0, samples.size() - 1};
  for (;;) {
    const LeastSquaresSpline fit(samples.weighted(), places(samples, knots));
    Knots next = halved(knots, errors_of(fit, samples, knots), kFewestInPiece);
    if (next.size() == knots.size()) return knots;
    knots = std::move(next);
  }
}

Knots most_predictive_knots(const Samples& samples) {
  const std::array<Samples, 2> halves{half_of(samples, 0), half_of(samples, 1)};
  Knots knots{0, samples.size() - 1}, best = knots;
  double least = prediction_error(halves, places(samples, knots));
  for (;;) {
    const LeastSquaresSpline fit(samples.weighted(), places(samples, knots));
    Knots next = halved(knots, errors_of(fit, samples, knots), kFewestInHalvedPiece);
    if (next.size() == knots.size()) return best;
    knots = std::move(next);
    const double error = prediction_error(halves, places(samples, knots));
    if (error < least) {
      least = error;
      best = knots;
    }
  }
}

/// Largest difference of the CDFs of which the samples have the given shares.
double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0, largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += a[i] - b[i];
    largest = std::max(largest, std::abs(difference));
  }
  return largest;
}

FitResidual residual_of(const LeastSquaresSpline& fit, const Samples& samples) {
  FitResidual residual{.samples = samples.size()};
  std::vector<double> given, fitted;
  double square = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    given.push_back(std::exp(samples.value[i]));
    fitted.push_back(std::exp(fit.at(samples.t[i])));
    square += samples.weight[i] * std::pow(fitted[i] / given[i] - 1, 2);
  }
  residual.density = std::sqrt(square);
  for (const int power : {1, 2})
    residual.u_error = std::max(
        residual.u_error,
        largest_difference(shares(samples.r, given, power), shares(samples.r, fitted, power)));
  return residual;
}

/// Returns the knots and samples between them, kFewestFitted in all if there are as many.
Knots densified(Knots knots) {
  while (knots.size() < kFewestFitted) {
    Knots denser{0};
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
      const std::size_t middle = (knots[k] + knots[k + 1]) / 2;
      if (middle > knots[k]) denser.push_back(middle);
      denser.push_back(knots[k + 1]);
    }
    if (denser.size() == knots.size()) break;
    knots = std::move(denser);
  }
  return knots;
}

FittedProfile fitted(const RadialProfile& profile, const Samples& samples, const Knots& knots) {
  const LeastSquaresSpline fit(samples.weighted(), places(samples, knots));
  FittedProfile result{{}, residual_of(fit, samples)};
  const auto add = [&](double r, double p22) {
    result.profile.r.push_back(r);
    result.profile.p22.push_back(p22);
  };
  if (profile.p22.front() == 0) add(profile.r.front(), 0);
  for (const std::size_t k : densified(knots)) add(samples.r[k], std::exp(fit.at(samples.t[k])));
  if (profile.p22.back() == 0) add(profile.r.back(), 0);
  return result;
}

}  // namespace

FittedProfile resampled(const RadialProfile& profile) {
  const Samples samples = positive_samples(profile);
  return fitted(profile, samples, closest_knots(samples));
}

FittedProfile smoothed(RadialProfile given) {
  const RadialProfile profile = checked_profile(std::move(given));
  const Samples samples = positive_samples(profile);
  if (samples.size() < kFewestToSmooth)
    throw std::invalid_argument("radial profile: it has " + std::to_string(samples.size()) +
                                " samples of positive density; at least " +
                                std::to_string(kFewestToSmooth) + " are needed to smooth them");
  return fitted(profile, samples, most_predictive_knots(samples));
}

}  // namespace vndf::distributions

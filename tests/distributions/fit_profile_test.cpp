// Long and noisy profiles against the distributions that were sampled.
#include "vndf/distributions/fit_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "support/catch.h"
#include "support/visible_difference.h"
#include "vndf/distributions/families.h"
#include "vndf/distributions/measured_profile.h"
#include "vndf/distributions/specification.h"

using namespace vndf;
using namespace vndf::distributions;
using namespace vndf::precompute;
using namespace vndf::test;

namespace {

/// `count` samples of `d` at equal steps up to `last`, with noise of the given relative size.
RadialProfile samples_of(const SlopeDistribution& d, int count, double last, double noise = 0) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  RadialProfile profile;
  for (int i = 0; i < count; ++i) {
    profile.r.push_back(last * i / (count - 1));
    profile.p22.push_back(d.p22(profile.r.back()) * std::exp(noise * normal(random)));
  }
  return profile;
}

/// Largest difference of the visible CDFs of `d` and of the profile, at every incidence.
double error_of(const MeasuredProfile& profile, const SlopeDistribution& d) {
  return largest_difference(UnitSlopes(d, {}), UnitSlopes(profile, {}));
}

/// Reaches so far that what lies beyond is below the errors that are measured.
constexpr double kBeckmannEnd = 5, kExponentialEnd = 30;

}  // namespace

TEST_CASE("10000 samples of smooth distributions keep their visible CDF with 256") {
  const Beckmann beckmann;
  const ExponentialPower exponential(1);
  const auto check = [](const SlopeDistribution& d, double last, ProfileTail tail) {
    const MeasuredProfile profile("long", samples_of(d, 10000, last), tail);
    CAPTURE(d.name(), profile.samples().r.size());
    REQUIRE(profile.resampling());
    CHECK(profile.samples().r.size() <= kMostProfileSamples);
    CHECK(profile.resampling()->samples == 10000);
    CHECK(profile.resampling()->u_error < kResamplingUError);
    CHECK(error_of(profile, d) < kResamplingUError);
  };
  check(beckmann, kBeckmannEnd, ProfileTail::none);
  check(exponential, kExponentialEnd, ProfileTail::exponential);
  // All the mass of GGX lies within a few of the samples, which are kept, and in a far tail.
  check(Ggx(), 1000, ProfileTail::power);
}

TEST_CASE("the samples that are kept make the same distribution again, bit for bit") {
  const MeasuredProfile profile("long", samples_of(Beckmann(), 1000, kBeckmannEnd, 0.05),
                                ProfileTail::exponential);
  const auto again = make_distribution(specify_profile(profile));
  for (const double r : {0.0, 0.1, 0.7, 2.0, 4.9, 6.0}) CHECK(again->p22(r) == profile.p22(r));
}

TEST_CASE("as many samples as are kept are not touched, and one more is fitted") {
  const auto samples = [](int count) { return samples_of(Beckmann(), count, kBeckmannEnd); };
  const MeasuredProfile kept("kept", samples(kMostProfileSamples), ProfileTail::none);
  CHECK_FALSE(kept.resampling());
  CHECK(kept.samples().p22 == samples(kMostProfileSamples).p22);
  CHECK(
      MeasuredProfile("fitted", samples(kMostProfileSamples + 1), ProfileTail::none).resampling());
}

TEST_CASE("zeros at the ends of a long profile stay where they are") {
  RadialProfile ring;
  for (int i = 0; i <= 1000; ++i) {
    ring.r.push_back(1 + i / 1000.0);
    ring.p22.push_back(std::sin(std::numbers::pi * i / 1000));
  }
  ring.p22.back() = 0;
  const MeasuredProfile profile("ring", ring, ProfileTail::none);
  CHECK(profile.support() == 2);
  CHECK(profile.p22(1) == 0);
  CHECK(profile.samples().r.size() <= kMostProfileSamples);
  CHECK(profile.p22(1.5) == Approx(1).epsilon(1e-6));
  CHECK(profile.mass() == Approx(6).epsilon(1e-5));  // 2 pi int r sin(pi (r - 1)) dr
}

TEST_CASE("smoothing takes noise away, tells its size, and comes nearer to the truth") {
  constexpr double kNoise = 0.05;
  const Beckmann truth;
  for (const int count : {60, 200, 5000}) {
    CAPTURE(count);
    const RadialProfile noisy = samples_of(truth, count, kBeckmannEnd, kNoise);
    const FittedProfile fit = smoothed(noisy);
    CHECK(fit.residual.samples == static_cast<std::size_t>(count));
    // The few samples that hold the mass are followed in part.
    CHECK(fit.residual.density == Approx(kNoise).epsilon(count < 100 ? 0.4 : 0.25));
    // Of n samples the noise that is left in the CDF is some kNoise / sqrt(n).
    const double expected = kNoise / std::sqrt(count);
    CHECK(fit.residual.u_error < 4 * expected);
    const MeasuredProfile smooth("smooth", fit.profile, ProfileTail::exponential);
    CHECK(error_of(smooth, truth) < 4 * expected);
    // Between the samples, where noise would show, the density is within a part of the noise.
    double worst = 0;
    for (double r = 0.5; r < 2; r += 1e-3)
      worst = std::max(worst, std::abs(smooth.p22(r) / smooth.mass() / truth.p22(r) - 1));
    CHECK(worst < 0.8 * kNoise);
  }
}

TEST_CASE("the reported u-error is that between the samples and the fit") {
  const RadialProfile noisy = samples_of(Beckmann(), 200, kBeckmannEnd, 0.2);
  const FittedProfile fit = smoothed(noisy);
  const MeasuredProfile through("through", noisy, ProfileTail::none),
      smooth("smooth", fit.profile, ProfileTail::none);
  const double difference = error_of(through, smooth);
  // One is of the radius, and the other of the slope x at the worst incidence.
  CHECK(fit.residual.u_error > difference / 3);
  CHECK(fit.residual.u_error < difference * 3);
}

TEST_CASE("smoothing leaves a profile without noise as it is") {
  const Beckmann truth;
  const FittedProfile fit = smoothed(samples_of(truth, 200, kBeckmannEnd));
  CHECK(fit.residual.density < 1e-5);
  const MeasuredProfile smooth("smooth", fit.profile, ProfileTail::none);
  CHECK(error_of(smooth, truth) < 1e-5);
}

TEST_CASE("samples that are no profile are not smoothed") {
  CHECK_THROWS_WITH(smoothed({{0, 1, 2, 3}, {1, 1e308, 1e308, 1}}), contains("use other units"));
  CHECK_THROWS_WITH(smoothed({{0, 1, 2, 3}, {0, 0, 0, 0}}), contains("zero at every sample"));
  RadialProfile hole = samples_of(Beckmann(), 20, 2);
  hole.p22[7] = 0;
  CHECK_THROWS_WITH(smoothed(hole), contains("zero between positive ones"));
}

TEST_CASE("seven samples are too few to smooth") {
  CHECK_THROWS_WITH(smoothed(samples_of(Beckmann(), 7, 2)),
                    contains("7 samples") && contains("at least 8"));
  CHECK(smoothed(samples_of(Beckmann(), 8, 2)).profile.r.size() >= kFewestProfileSamples);
}

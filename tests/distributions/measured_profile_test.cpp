// Distributions from samples: against the distributions that were sampled, and their shape and
// tails.
#include "vndf/distributions/measured_profile.h"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "support/catch.h"
#include "support/visible_difference.h"

using namespace vndf;
using namespace vndf::distributions;
using namespace vndf::precompute;
using namespace vndf::test;

namespace {

/// The visible CDF of a distribution sampled at 200 places; measured: 6e-9 and 1.4e-7.
constexpr double kInterpolationUError = 1e-6;
/// marginals() against closed forms, relative, where interpolation adds up to 4e-8.
constexpr double kMarginalError = 1e-7;

/// Student-T slopes of gamma = 5/2.
class StudentT final : public SlopeDistribution {
 public:
  std::string name() const override { return "student-t"; }
  double p22(double r) const override {
    return std::pow(1 + r * r / kScale, -kGamma) * std::numbers::inv_pi;
  }
  static Marginals closed(double x) {
    const double w = 1 + x * x / kScale;
    const double at_zero =
        std::tgamma(kGamma - 0.5) * std::sqrt(kScale / std::numbers::pi) / std::tgamma(kGamma);
    return {at_zero / kScale * (kGamma - 1) * std::pow(w, 0.5 - kGamma),
            boost::math::ibeta(kGamma - 1, 0.5, 1 / w) / 2,
            at_zero * kScale / (2 * kGamma - 3) * std::pow(w, 1.5 - kGamma)};
  }

 private:
  static constexpr double kGamma = 2.5, kScale = kGamma - 1;
};

using Function = std::function<double(double)>;

/// `count` samples of `density` at radius(v), v from 0 to 1.
RadialProfile samples_of(const Function& density, const Function& radius, int count = 200) {
  RadialProfile profile;
  for (int i = 0; i < count; ++i) {
    profile.r.push_back(radius(i / (count - 1.0)));
    profile.p22.push_back(density(profile.r.back()));
  }
  return profile;
}

double student(double r) {
  return StudentT().p22(r);
}
double logarithmic(double v) {
  return 1e-3 * std::pow(1e6, v);
}
double arc(double v) {
  return std::tan(std::numbers::pi / 2 * (0.0025 + 0.995 * v));
}

/// Whether p22 between two samples never leaves their range.
bool keeps_to_samples(const MeasuredProfile& profile) {
  const auto& [r, p22] = profile.samples();
  for (std::size_t i = 1; i < r.size(); ++i)
    for (double v = 0; v <= 1; v += 1.0 / 64) {
      const double density = profile.p22(std::lerp(r[i - 1], r[i], v));
      const auto [low, high] = std::minmax(p22[i - 1], p22[i]);
      if (density < low * (1 - 1e-12) || density > high * (1 + 1e-12)) return false;
    }
  return true;
}

RadialProfile noisy(RadialProfile profile, double relative) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (double& density : profile.p22) density *= std::exp(relative * normal(random));
  return profile;
}

}  // namespace

TEST_CASE("200 samples of a Student-T distribution give its visible CDF at every incidence") {
  const StudentT exact;
  const UnitSlopes exact_slopes(exact, {});
  for (const Function& radius : {Function(logarithmic), Function(arc)}) {
    const MeasuredProfile profile("sampled", samples_of(student, radius), ProfileTail::power);
    CHECK(largest_difference(exact_slopes, UnitSlopes(profile, {})) < kInterpolationUError);
    CHECK(profile.tail().parameter == Approx(5).epsilon(0.01));
    CHECK(keeps_to_samples(profile));
  }
}

TEST_CASE("marginals, mass and mean slope equal the closed forms") {
  const MeasuredProfile profile("sampled", samples_of(student, logarithmic), ProfileTail::power);
  for (const double x : {0.0, 1e-12, 1e-4, 0.1, 1.0, 30.0, 999.0, 1e4}) {
    CAPTURE(x);
    const Marginals exact = StudentT::closed(x), measured = *profile.marginals(x);
    const double tolerance = x < 500 ? kMarginalError : 1e-4;  // the tail is a fit
    CHECK(measured.p == Approx(exact.p).epsilon(tolerance));
    CHECK(measured.q == Approx(exact.q).epsilon(tolerance));
    CHECK(measured.m == Approx(exact.m).epsilon(tolerance));
  }
  CHECK(profile.mass() == Approx(1).epsilon(kMarginalError));
  CHECK(profile.mean_slope() == Approx(2 * StudentT::closed(0).m).epsilon(kMarginalError));
}

TEST_CASE("the curve passes through the samples and is constant before the first") {
  const RadialProfile samples = samples_of(
      student, [](double v) { return 0.3 + 4 * v; }, 12);
  const MeasuredProfile profile("sampled", samples, ProfileTail::power);
  for (std::size_t i = 0; i < samples.r.size(); ++i)
    CHECK(profile.p22(samples.r[i]) == Approx(samples.p22[i]).epsilon(1e-13));
  for (const double r : {0.0, 0.1, 0.29}) CHECK(profile.p22(r) == samples.p22[0]);
}

TEST_CASE("noise and steps cause no overshoot") {
  const auto samples = noisy(samples_of(student, arc), 0.1);
  const MeasuredProfile profile("noisy", samples, ProfileTail::power);
  CHECK(keeps_to_samples(profile));
  CHECK(profile.mass() == Approx(1).epsilon(0.05));
  CHECK(profile.marginals(0)->q == Approx(profile.mass() / 2));
  const MeasuredProfile step("step", {{0, 1, 2, 3, 4, 5}, {1, 1, 1, 1e-6, 1e-6, 1e-6}},
                             ProfileTail::none);
  CHECK(keeps_to_samples(step));
}

TEST_CASE("without a tail the support ends at the last sample") {
  const MeasuredProfile disk("disk", {{0, 0.5, 0.7, 1}, {1, 1, 1, 1}}, ProfileTail::none);
  CHECK(disk.support() == 1);
  CHECK(disk.breaks() == std::vector<double>{1});
  CHECK(disk.p22(1.0000001) == 0);
  CHECK(disk.mass() == Approx(std::numbers::pi));
  for (const double x : {0.0, 0.3, 0.9}) {
    const double chord = std::sqrt(1 - x * x);
    CHECK(disk.marginals(x)->p == Approx(2 * chord));
    CHECK(disk.marginals(x)->q == Approx(std::acos(x) - x * chord));
    CHECK(disk.marginals(x)->m == Approx(2 * chord * chord * chord / 3));
  }
  CHECK(disk.marginals(1)->q == 0);
}

TEST_CASE("zeros among the samples are joined by straight lines; at the end they end the support") {
  const MeasuredProfile ring("ring", {{1, 2, 3, 4, 5, 6, 7}, {0, 2, 3, 2, 0, 0, 0}},
                             ProfileTail::none);
  CHECK(ring.support() == 5);
  CHECK(ring.breaks() == std::vector<double>{1, 2, 4, 5});
  CHECK(ring.p22(0.5) == 0);
  CHECK(ring.p22(1.5) == Approx(1));
  CHECK(ring.p22(4.75) == Approx(0.5));
  CHECK(ring.p22(6) == 0);
  CHECK(ring.samples().r.size() == 5);
}

TEST_CASE("an exponential tail continues the last samples") {
  const auto density = [](double r) { return std::exp(-2 * r); };
  const auto samples = samples_of(density, [](double v) { return 3 * v; });
  const MeasuredProfile profile("sampled", samples, ProfileTail::exponential);
  CHECK(profile.tail().kind == ProfileTail::exponential);
  CHECK(profile.tail().parameter == Approx(2));
  CHECK(profile.tail().residual < 1e-12);
  CHECK(profile.tail().fraction_of_mass_beyond == Approx(7 * std::exp(-6)).epsilon(1e-3));
  CHECK(profile.p22(10) == Approx(density(10)));
  CHECK(profile.support() == std::numeric_limits<double>::infinity());
  CHECK(profile.breaks() == std::vector<double>{3});
}

TEST_CASE("a power tail reports its exponent, residual and mass; a declared one is not fitted") {
  const auto density = [](double r) { return std::pow(1 + r, -4); };
  const auto radius = [](double v) { return 1000 * std::pow(v, 4); };
  const auto samples = samples_of(density, radius);
  const MeasuredProfile fitted("sampled", samples, ProfileTail::power);
  CHECK(fitted.tail().parameter == Approx(4).epsilon(1e-2));
  CHECK(fitted.tail().fraction_of_mass_beyond == Approx(3e-6).epsilon(1e-2));
  const MeasuredProfile scattered("sampled", noisy(samples, 0.1), ProfileTail::power);
  CHECK(scattered.tail().residual == Approx(0.1).epsilon(0.6));
  const MeasuredProfile declared("sampled", samples, ProfileTail::power, 6.0);
  CHECK(declared.tail().parameter == 6);
  CHECK(declared.tail().residual == 0);
  CHECK(declared.p22(2000) == Approx(density(1000) / 64));
}

TEST_CASE("tails without a finite mean slope are refused with what was fitted") {
  const auto radius = [](double v) { return 1 + v; };
  const auto cubic = samples_of([](double r) { return std::pow(r, -2.5); }, radius);
  CHECK_THROWS_WITH(MeasuredProfile("flat", cubic, ProfileTail::power),
                    contains("'flat'") && contains("r^-2.5") && contains("above 3"));
  const auto rising = samples_of([](double r) { return r; }, radius);
  CHECK_THROWS_WITH(MeasuredProfile("rising", rising, ProfileTail::exponential),
                    contains("does not fall"));
  const RadialProfile ended{{0, 1, 2, 3}, {1, 1, 1, 0}};
  CHECK_THROWS_WITH(MeasuredProfile("ended", ended, ProfileTail::power),
                    contains("zero at the last sample"));
  CHECK_THROWS_AS(MeasuredProfile("ended", ended, ProfileTail::power), std::domain_error);
}

TEST_CASE("samples that are no profile are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto make = [](RadialProfile samples) {
    return MeasuredProfile("bad", std::move(samples), ProfileTail::none);
  };
  CHECK_THROWS_AS(make({{0, 1, 2}, {1, 1, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(make({{0, 1, 2, 3}, {1, 1, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(make({{0, 1, 1, 3}, {1, 1, 1, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(make({{-1, 1, 2, 3}, {1, 1, 1, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(make({{0, 1, 2, 3}, {1, -1, 1, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(make({{0, 1, 2, 3}, {1, nan, 1, 1}}), std::invalid_argument);
  CHECK_THROWS_WITH(make({{0, 1, 2, 3}, {0, 0, 0, 0}}), contains("zero at every sample"));
}

TEST_CASE("samples whose integrals would overflow are refused before any work") {
  const auto refused = [](RadialProfile samples, const std::string& why) {
    for (const auto tail : {ProfileTail::none, ProfileTail::exponential, ProfileTail::power})
      CHECK_THROWS_WITH(MeasuredProfile("bad", samples, tail), contains(why));
  };
  refused({{0, 1, 2, 3}, {1, 1e308, 1e308, 1}}, "sample 2 (r = 1, p22 = 1e+308)");
  refused({{0, 1, 2, 3, 4}, {1, 1e308, 1e308, 1e-308, 1e-320}}, "use other units");
  refused({{0, 1, 1e155, 1e200}, {1, 1, 1, 1}}, "sample 3 (r = 1e+155, p22 = 1)");
  refused({{0, 1e-170, 1, 2}, {1, 1, 1, 1}}, "sample 2 (r = 1e-170, p22 = 1)");
  refused({{0, 1, 2, 3}, {1e-40, 1e-40, 1e-40, 1e-40}}, "below 1e-30 at every sample");
  refused({{0, 1, 1.0000000000000002, 5}, {1, 2, 1, 1}}, "differs from the one before");
  const RadialProfile far{{0, 1e-6, 1e-3, 1e8}, {1, 1, 1e-9, 1e-60}};
  CHECK_THROWS_WITH(MeasuredProfile("far", far, ProfileTail::none),
                    contains("its last sample lies at r = 1e+08, and the mean slope is"));
}

TEST_CASE("tails that leave nothing within the samples or beyond them are refused") {
  const RadialProfile samples{{0, 1, 2, 3}, {1, 1, 1, 1}};
  const auto refused = [&](ProfileTail tail, double parameter, const std::string& why) {
    CHECK_THROWS_WITH(MeasuredProfile("tail", samples, tail, parameter), contains(why));
  };
  refused(ProfileTail::exponential, 1e-300, "too flat");
  refused(ProfileTail::exponential, 0.016, "too flat");
  refused(ProfileTail::exponential, 1e300, "too steep");
  refused(ProfileTail::power, 1e7, "too steep");
  for (const double rate : {0.017, 3e5}) {
    const MeasuredProfile profile("tail", samples, ProfileTail::exponential, rate);
    CHECK(std::isfinite(profile.mean_slope()));
  }
}

TEST_CASE("numbers at the limits have finite integrals") {
  constexpr double kLarge = kLargestRadius, kSmall = kSmallestRadius;
  for (const double density : {kLargestPeak, kSmallestPeak}) {
    const MeasuredProfile near(
        "near", {{0, kSmall, 2 * kSmall, 3 * kSmall}, {0, density, 1e-320, 0}}, ProfileTail::none);
    const MeasuredProfile far("far",
                              {{0, 0.3 * kLarge, 0.6 * kLarge, kLarge}, {0, density, 1e-320, 0}},
                              ProfileTail::none);
    for (const MeasuredProfile& profile : {near, far}) {
      CHECK(profile.mass() > 0);
      CHECK(std::isfinite(profile.mass()));
      CHECK(profile.mean_slope() > 0);
      CHECK(std::isfinite(profile.mean_slope()));
    }
  }
}

TEST_CASE("a zero between positive samples is refused; zeros at both ends are not") {
  const auto make = [](std::vector<double> p22) {
    return MeasuredProfile("zeros", {{0, 1, 2, 3, 4, 5}, std::move(p22)}, ProfileTail::none);
  };
  CHECK_THROWS_WITH(make({1, 1, 0, 1, 1, 1}), contains("sample 3 (r = 2, p22 = 0)"));
  CHECK_THROWS_WITH(make({0, 1, 0, 0, 1, 0}), contains("zero between positive ones"));
  CHECK(make({0, 0, 1, 2, 1, 0}).samples().r == std::vector<double>{1, 2, 3, 4, 5});
}

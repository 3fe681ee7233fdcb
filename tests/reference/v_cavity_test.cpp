// The V-cavity model: its masking conserves projected area, its normals follow D_wi.
#include "vndf/reference/v_cavity.h"

#include "support/catch.h"
#include "support/hemisphere_integral.h"
#include "support/pair_test.h"
#include "support/tolerances.h"
#include "vndf/reference/beckmann_ndf.h"
#include "vndf/reference/blinn_phong_ndf.h"
#include "vndf/reference/ggx_ndf.h"

using namespace vndf;
using namespace vndf::test;

namespace {

template <class T>
using GgxCavity = VCavity<GgxNdf<T>>;

/// Normals to (turns of the stretched azimuth, 1 - 1 / (1 + r^2)): uniform for all GGX normals.
struct PolarDistribution {
  Alpha<double> alpha;
  template <class T>
  Vec2<double> operator()(const Vec3<T>& m) const {
    const double x = double{m.x} / alpha.x, y = double{m.y} / alpha.y, z = m.z;
    const double turn = std::atan2(y, x) / (2 * std::numbers::pi), r2 = x * x + y * y;
    return {turn < 0 ? turn + 1 : turn, r2 / (r2 + z * z)};
  }
};

/// The share of visible GGX normals in each bin of the pair test, by the midpoint rule: all normals
/// have equal shares, and D_wi / (D wm.z) is G1 dot(wi, wm)+ / (wi.z wm.z).
std::vector<double> visible_shares(const Vec3<double>& wi, const Alpha<double>& alpha) {
  constexpr int kPoints = 40;
  const GgxCavity<double> cavity;
  std::vector<double> shares;
  double total = 0;
  for (std::size_t i = 0; i < kColumns; ++i)
    for (std::size_t j = 0; j < kRows; ++j) {
      double sum = 0;
      for (int k = 0; k < kPoints; ++k)
        for (int l = 0; l < kPoints; ++l) {
          const double turn = (static_cast<double>(i) + (k + 0.5) / kPoints) / kColumns;
          const double u = (static_cast<double>(j) + (l + 0.5) / kPoints) / kRows;
          const double r = std::sqrt(u), phi = 2 * std::numbers::pi * turn;
          const auto m = normalize_or_up(Vec3<double>{
              alpha.x * r * std::cos(phi), alpha.y * r * std::sin(phi), std::sqrt(1 - u)});
          sum += cavity.g1(wi, m, alpha) * std::max(0.0, dot(wi, m)) / (wi.z * m.z);
        }
      shares.push_back(sum);
      total += sum;
    }
  for (double& share : shares) share /= total;
  return shares;
}

/// The exact form, of which the third number is drawn beside the other two.
template <class T>
struct ThreeNumbers {
  GgxCavity<T> cavity = GgxCavity<T>();
  mutable std::mt19937 random{7};
  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const {
    return cavity.sample(wi, alpha, u1, u2, std::ldexp(static_cast<T>(random() >> 8), -24));
  }
};

const Alpha<double> kAlpha{0.3, 0.9};

}  // namespace

TEST_CASE("V-cavity masking conserves the projected area and its pdf integrates to 1") {
  const GgxCavity<double> ggx;
  const VCavity<BlinnPhongNdf<double>> blinn_phong;
  for (const double degrees : {0.0, 30.0, 75.0, 89.0}) {
    CAPTURE(degrees);
    const auto wi = direction_at<double>(degrees, 35);
    const auto area = [&](const Vec3<double>& m) {
      return ggx.g1(wi, m, kAlpha) * std::max(0.0, dot(wi, m)) * ggx.d(m, kAlpha);
    };
    CHECK(over_normals(area, wi, kAlpha) == Approx(wi.z).epsilon(1e-4));
    const auto pdf = [&](const Vec3<double>& m) { return ggx.pdf(wi, m, kAlpha); };
    CHECK(over_normals(pdf, wi, kAlpha) == Approx(1).margin(1e-4));
    const auto other = [&](const Vec3<double>& m) { return blinn_phong.pdf(wi, m, {0.3, 0.3}); };
    CHECK(over_normals(other, wi, {0.3, 0.3}) == Approx(1).margin(1e-4));
  }
}

TEST_CASE("the V-cavity pdf is D_wi with the masking of the facet") {
  const GgxCavity<double> cavity;
  for (const double degrees : {0.0, 40.0, 80.0, 89.99})
    for (const double tilt : {0.0, 20.0, 70.0, 89.0})
      for (const double phi : {0.0, 100.0, 200.0}) {
        const auto wi = direction_at<double>(degrees, 10), m = direction_at<double>(tilt, phi);
        const double facing = std::max(0.0, dot(wi, m));
        CAPTURE(degrees, tilt, phi);
        CHECK(cavity.pdf(wi, m, kAlpha) ==
              Approx(cavity.g1(wi, m, kAlpha) * facing * cavity.d(m, kAlpha) / wi.z)
                  .epsilon(1e-12)
                  .margin(1e-300));
      }
}

TEST_CASE("V-cavity normals pass a chi-square test, with a third number and without") {
  for (const double degrees : {0.0, 40.0, 75.0, 89.0}) {
    CAPTURE(degrees);
    const auto wi = direction_at<double>(degrees, 35);
    const auto shares = visible_shares(wi, kAlpha);
    const PolarDistribution distribution{kAlpha};
    CHECK(distribution_p_value(distribution, ThreeNumbers<double>(), wi, kAlpha, shares) >
          kSignificance);
    CHECK(distribution_p_value(distribution, GgxCavity<double>(), wi, kAlpha, shares) >
          kSignificance);
    // In float, whose u3 has 12 digits.
    const Vec3<float> w{static_cast<float>(wi.x), static_cast<float>(wi.y),
                        static_cast<float>(wi.z)};
    CHECK(distribution_p_value(distribution, GgxCavity<float>(), w, Alpha<float>{0.3f, 0.9f},
                               shares) > kSignificance);
  }
}

TEST_CASE("the chi-square test rejects V-cavity normals of which none, or each, is exchanged") {
  const auto wi = direction_at<double>(60, 35);
  const auto shares = visible_shares(wi, kAlpha);
  struct Fixed {
    double u3;
    GgxCavity<double> cavity = GgxCavity<double>();
    Vec3<double> sample(const Vec3<double>& w, const Alpha<double>& a, double u1, double u2) const {
      return cavity.sample(w, a, u1, u2, u3);
    }
  };
  CHECK(distribution_p_value(PolarDistribution{kAlpha}, GgxNdf<double>(), wi, kAlpha, shares) <
        kSignificance);
  CHECK(distribution_p_value(PolarDistribution{kAlpha}, Fixed{0.3}, wi, kAlpha, shares) <
        kSignificance);
}

TEST_CASE("stratified numbers choose sides evenly: each of 4096 strata of u1, in float") {
  // Jittered u1, one in each stratum, at a fixed groove radius: the share of facets on the facing
  // side, in a half turn of azimuth, is far closer to its expectation than by independent choices.
  const GgxCavity<float> cavity;
  const auto wi = direction_at<float>(60);
  const Alpha<float> alpha{0.5f, 0.5f};
  constexpr int kStrata = 4096, kRepeats = 64;
  std::mt19937 random(3);
  double facing = 0;
  for (int r = 0; r < kRepeats; ++r)
    for (int k = 0; k < kStrata; ++k) {
      const float jitter =
          (static_cast<float>(r) + std::ldexp(static_cast<float>(random() >> 8), -24)) / kRepeats;
      const float u1 = (static_cast<float>(k) + jitter) / kStrata;
      facing += cavity.sample(wi, alpha, u1, 0.5f).x > 0;
    }
  // Expected: the mean over the azimuth phi of the greater share, 1/2 + slope tan(theta) cos / 2
  // cut at 1.
  double expected = 0;
  constexpr int kSteps = 100000;
  for (int k = 0; k < kSteps; ++k) {
    const double cosine = std::cos(std::numbers::pi * ((k + 0.5) / kSteps - 0.5));
    expected += std::min(1.0, 0.5 + 0.5 * 0.5 * std::sqrt(3.0) * cosine);
  }
  const double mean = facing / (kStrata * kRepeats);
  CHECK(mean == Approx(expected / kSteps).margin(GgxCavity<float>::kReuseError));
}

TEST_CASE(
    "the distribution of a groove's side errs by no more than kReuseError without a third number") {
  // All u1 of 24 bits at one groove radius: the azimuth of the chosen facet against its CDF,
  // int_0^phi (1 + k cos) / (2 pi), k = r tan(theta), where both sides are visible.
  const GgxCavity<float> cavity;
  const auto wi = direction_at<float>(40);
  const float u2 = 0.3f;
  const double r = 0.5 * std::sqrt(0.3 / 0.7), k = r * double{wi.x} / double{wi.z};
  REQUIRE(k < 1);
  std::vector<double> numbers;
  constexpr int kSkip = 61;  // odd, so that the last digits take every value
  for (int n = 0; n < 1 << 24; n += kSkip) {
    const auto m = cavity.sample(wi, {0.5f, 0.5f}, std::ldexp(static_cast<float>(n), -24), u2);
    const double phi = std::atan2(double{m.y}, double{m.x});
    const double turn = phi < 0 ? phi + 2 * std::numbers::pi : phi;
    numbers.push_back((turn + k * std::sin(turn)) / (2 * std::numbers::pi));
  }
  CHECK(distance_from_uniform(numbers) <= GgxCavity<float>::kReuseError);
}

TEST_CASE("the two-argument G1 is the mean of the facets' masking, by projected area") {
  const GgxCavity<double> cavity;
  const auto wi = direction_at<double>(70, 35);
  const auto masked = [&](const Vec3<double>& m) {
    return cavity.g1(wi, m, kAlpha) * std::max(0.0, dot(wi, m)) * cavity.d(m, kAlpha);
  };
  const auto all = [&](const Vec3<double>& m) {
    return std::max(0.0, dot(wi, m)) * cavity.d(m, kAlpha);
  };
  CHECK(over_normals(masked, wi, kAlpha) / over_normals(all, wi, kAlpha) ==
        Approx(cavity.g1(wi, kAlpha)).epsilon(1e-4));
}

TEST_CASE("the side of a groove that faces away is never chosen, whatever u3 is") {
  const GgxCavity<double> cavity;
  const auto wi = direction_at<double>(85, 35);
  for (const double u3 : {-1.0, 0.0, 0.5, 1.0, 2.0, std::nan("")})
    for (const double u1 : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0})
      for (const double u2 : {0.0, 0.5, 0.99, 1.0}) {
        CAPTURE(u1, u2, u3);
        CHECK(dot(wi, cavity.sample(wi, kAlpha, u1, u2, u3)) >= 0);
      }
}

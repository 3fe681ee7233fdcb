// Masking models against their definitions in Lambda, and their limits.
#include "vndf/bsdf/masking.h"

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <limits>

#include "support/bsdf_inputs.h"
#include "support/catch.h"

using namespace vndf;
using namespace vndf::test;

namespace {

static_assert(MaskingModel<SmithSeparable, ExactGgx<double>, double>);
static_assert(MaskingModel<SmithCorrelated, ExactGgx<double>, double>);
static_assert(MaskingModel<VCavityMasking, ExactGgx<double>, double>);

const std::vector<double> kLambdas{0, 1e-12, 1e-3, 0.3, 1, 2.5, 7, 40, 1e3};

double g_of(double lambda) {
  return 1 / (1 + lambda);
}

/// Calls f with wi above, wo on either side, wm and alpha, of usual and of hard cases.
template <class F>
void for_random_facets(F f) {
  RandomInputs random(3);
  for (int i = 0; i < 20000; ++i) {
    const auto hard = random.hard();
    const auto other = random.hard();
    const auto m = ExactGgx<double>{}.sample(hard.wi, hard.alpha, other.u1, other.u2);
    const double side = random.uniform() < 0.5 ? 1 : -1;
    f(hard.wi, Vec3<double>{other.wi.x, other.wi.y, side * other.wi.z}, m, hard.alpha);
  }
}

template <class M>
double g2_of(const Vec3<double>& wi, const Vec3<double>& wo, const Vec3<double>& wm,
             const Alpha<double>& alpha) {
  return g2<M>(ExactGgx<double>{}, wi, wo, wm, alpha);
}

/// G2 is symmetric, within [0, G1], and 0 unless both directions see the facet.
template <class M>
void check_g2(double relative, double absolute) {
  for_random_facets([&](const auto& wi, const auto& wo, const auto& wm, const auto& alpha) {
    const double value = g2_of<M>(wi, wo, wm, alpha), swapped = g2_of<M>(wo, wi, wm, alpha);
    CAPTURE(wi.x, wi.y, wi.z, wo.x, wo.y, wo.z, wm.x, wm.y, wm.z, alpha.x, alpha.y);
    REQUIRE(std::isfinite(value));
    REQUIRE(std::abs(value - swapped) <= relative * value + absolute);
    const ExactGgx<double> ggx;
    REQUIRE(value <= M::g1(ggx, wi, wm, alpha));
    REQUIRE(value >= 0);
    if (!sees_facet(wi, wm) || !sees_facet(wo, wm)) REQUIRE(value == 0);
  });
}

}  // namespace

TEST_CASE("Stirling's correction and the beta function are right to the stated errors") {
  for (double z = 1; z < 1e9; z *= 1.01) {
    const long double w = z;
    const long double exact = boost::math::lgamma(w) - ((w - 0.5L) * std::log(w) - w) -
                              0.5L * std::log(2 * std::numbers::pi_v<long double>);
    // The reference itself cancels.
    REQUIRE(std::abs(double{stirling_excess(z)} - static_cast<double>(exact)) <
            kStirlingError + 1e-18 * z * std::log(z));
  }
  RandomInputs random(1);
  for (int i = 0; i < 20000; ++i) {
    const double a = 1 + std::pow(10, 14 * random.uniform() - 7);
    const double b = 1 + std::pow(10, 14 * random.uniform() - 7);
    const float fa = static_cast<float>(a), fb = static_cast<float>(b);
    const double exact = boost::math::beta(a, b);
    const double exact_of_float = boost::math::beta(double{fa}, double{fb});
    CAPTURE(a, b);
    if (exact > 1e-100) REQUIRE(std::abs(beta_function(a, b) / exact - 1) <= kBetaError);
    const double roundings = kBetaRoundings * std::numeric_limits<float>::epsilon();
    if (exact_of_float > 1e-30)
      REQUIRE(std::abs(double{beta_function(fa, fb)} / exact_of_float - 1) <=
              roundings * (1 + std::abs(std::log(exact_of_float))));
  }
}

TEST_CASE("height-correlated reflection is 1 / (1 + Lambda_i + Lambda_o)") {
  for (const double i : kLambdas)
    for (const double o : kLambdas)
      CHECK(g_of(i) * SmithCorrelated::shadowing_of_reflection(g_of(i), g_of(o)) ==
            Approx(1 / (1 + i + o)).epsilon(1e-14));
}

TEST_CASE("G2 / G1 is right to kShadowingRoundings for given G1") {
  const auto check = [](auto one) {
    using T = decltype(one);
    const double bound = kShadowingRoundings * double{std::numeric_limits<T>::epsilon()};
    RandomInputs random(2);
    for (int i = 0; i < 20000; ++i) {
      const T gi = static_cast<T>(1 - random.uniform()), go = static_cast<T>(1 - random.uniform());
      const long double a = gi, b = go;
      const auto error = [](T value, long double exact) {
        return std::abs(static_cast<double>(value - exact));
      };
      const long double correlated = b / (a + b - a * b);
      CAPTURE(gi, go);
      REQUIRE(error(SmithSeparable::shadowing_of_reflection(gi, go), b) == 0);
      REQUIRE(error(SmithCorrelated::shadowing_of_reflection(gi, go), correlated) <=
              bound * static_cast<double>(correlated));
      REQUIRE(error(VCavityMasking::shadowing_of_reflection(gi, go), std::min(1.0L, b / a)) <=
              bound);
      REQUIRE(error(VCavityMasking::shadowing_of_transmission(gi, go),
                    std::max(0.0L, a + b - 1) / a) <= bound);
    }
  };
  check(1.0f);
  check(1.0);
}

TEST_CASE("height-correlated transmission is the mean over heights of both visibilities") {
  boost::math::quadrature::tanh_sinh<double> integrator;
  for (const double i : kLambdas)
    for (const double o : kLambdas) {
      const double exact = integrator.integrate(
          [&](double, double c) {  // minus h near 0, 1 - h near 1
            const double h = c < 0 ? -c : 1 - c, rest = c < 0 ? 1 + c : c;
            return std::pow(h, i) * std::pow(rest, o);
          },
          0.0, 1.0);
      CAPTURE(i, o);
      if (exact < 1e-100) continue;
      CHECK(g_of(i) * SmithCorrelated::shadowing_of_transmission(g_of(i), g_of(o)) ==
            Approx(exact).epsilon(1e-9));
    }
}

TEST_CASE("separable masking is the product of both") {
  const ExactGgx<double> ggx;
  const auto wi = direction_at<double>(70), wo = direction_at<double>(50, 120);
  const Vec3<double> m = normalize_or_up(Vec3<double>{0.2, 0.1, 1}), below{wo.x, wo.y, -wo.z};
  const Alpha<double> alpha{0.5, 0.3};
  CHECK(g2_of<SmithSeparable>(wi, wo, m, alpha) == Approx(ggx.g1(wi, alpha) * ggx.g1(wo, alpha)));
  const Vec3<double> turned{-m.x, -m.y, m.z};
  CHECK(sees_facet(below, turned) == (dot(below, turned) < 0));
  CHECK(g2_of<SmithSeparable>(wi, below, m, alpha) ==
        Approx(sees_facet(below, m) ? ggx.g1(wi, alpha) * ggx.g1(wo, alpha) : 0));
}

TEST_CASE("V-cavities mask by the twin facet alone") {
  const ExactGgx<double> ggx;
  const Alpha<double> alpha{0.5, 0.5};
  // Facet and twin seen from the side: the part of the facet that the twin leaves in sight, by the
  // similar triangles of the cavity, is 2 wm.z w.z / (w.wm).
  const auto m = direction_at<double>(40), near = direction_at<double>(30),
             low = direction_at<double>(80);
  CHECK(VCavityMasking::g1(ggx, near, m, alpha) == 1);
  CHECK(VCavityMasking::g1(ggx, low, m, alpha) ==
        Approx(2 * std::cos(40 * kDegree) * std::cos(80 * kDegree) / std::cos(40 * kDegree)));
  CHECK(VCavityMasking::g1(ggx, direction_at<double>(80, 180), m, alpha) == 0);
  CHECK(VCavityMasking::shadowing_of_reflection(0.5, 0.4) == Approx(0.4 / 0.5));
  CHECK(VCavityMasking::shadowing_of_reflection(0.4, 0.5) == 1);
  CHECK(VCavityMasking::shadowing_of_transmission(0.5, 0.4) == 0);
  CHECK(VCavityMasking::shadowing_of_transmission(0.8, 0.5) == Approx(0.3 / 0.8));
}

TEST_CASE("G2 is symmetric, at most G1, and 0 for a facet that one direction does not see") {
  // A G2 near the least number there is has no relative rounding: each operation errs by that.
  constexpr double kLeast = 4 * std::numeric_limits<double>::denorm_min();
  constexpr double kSmallestG1 = 1e-18;  // a lower one counts as this in correlated transmission
  check_g2<SmithSeparable>(1e-15, kLeast);
  check_g2<SmithCorrelated>(1e-12, kSmallestG1);
  check_g2<VCavityMasking>(1e-15, 1e-15);  // it takes the difference of numbers near 1
}

TEST_CASE("G2 / G1 has its limits where Lambda is infinite, in both precisions") {
  const auto check = [](auto one) {
    using T = decltype(one);
    const T tiny = std::numeric_limits<T>::min();
    for (const T gi : {T(0), tiny, T(1e-10), T(0.5), T(1)})
      for (const T go : {T(0), tiny, T(1e-10), T(0.5), T(1)}) {
        CAPTURE(gi, go);
        for (const T s : {SmithSeparable::shadowing_of_reflection(gi, go),
                          SmithSeparable::shadowing_of_transmission(gi, go),
                          SmithCorrelated::shadowing_of_reflection(gi, go),
                          SmithCorrelated::shadowing_of_transmission(gi, go),
                          VCavityMasking::shadowing_of_reflection(gi, go),
                          VCavityMasking::shadowing_of_transmission(gi, go)})
          CHECK((s >= 0 && s <= 1));
      }
    // (1 + Lambda_i) / (1 + Lambda_i + Lambda_o) -> 1 as Lambda_i grows, -> 0 as Lambda_o does.
    CHECK(SmithCorrelated::shadowing_of_reflection(T(0), T(0.1)) == 1);
    CHECK(SmithCorrelated::shadowing_of_reflection(T(0.1), T(0)) == 0);
    // (1 + Lambda_i) B(1 + Lambda_i, 1 + Lambda_o) -> Gamma(1 + Lambda_o) Lambda_i^-Lambda_o -> 0,
    // but 1 where nothing is shadowed.
    CHECK(SmithCorrelated::shadowing_of_transmission(T(0), T(0.5)) < T(1e-15));
    CHECK(SmithCorrelated::shadowing_of_transmission(T(0), T(1)) == Approx(1).epsilon(1e-5));
  };
  check(1.0f);
  check(1.0);
}

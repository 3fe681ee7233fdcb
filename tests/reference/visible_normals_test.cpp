// Tests of the tests of the reference samplers: each must reject samplers that are known to be
// wrong and accept the exact ones.
#include "support/visible_normals.h"

#include "support/catch.h"
#include "support/pair_test.h"
#include "support/tolerances.h"
#include "vndf/reference/beckmann_exact.h"
#include "vndf/reference/ggx_caps.h"
#include "vndf/reference/ggx_exact.h"
#include "vndf/reference/ggx_ndf.h"

using namespace vndf;
using namespace vndf::test;

namespace {

const Vec3<double> kWi = direction_at<double>(60, 35);
const Alpha<double> kAlpha{0.3, 0.9};

/// GgxExact with a mistake in what it is given.
template <class Mistake>
struct Mistaken {
  Mistake mistake;
  GgxExact<double> exact = {};
  Vec3<double> sample(Vec3<double> wi, Alpha<double> alpha, double u1, double u2) const {
    mistake(wi, alpha, u1, u2);
    return exact.sample(wi, alpha, u1, u2);
  }
  double pdf(const Vec3<double>& wi, const Vec3<double>& wm, const Alpha<double>& alpha) const {
    return exact.pdf(wi, wm, alpha);
  }
};
template <class Mistake>
Mistaken(Mistake) -> Mistaken<Mistake>;

void swap_alphas(Vec3<double>&, Alpha<double>& alpha, double&, double&) {
  std::swap(alpha.x, alpha.y);
}

}  // namespace

TEST_CASE("the exact samplers pass the pair test") {
  CHECK(visible_p_value<GgxForms>(GgxExact<double>(), kWi, kAlpha) > kSignificance);
  CHECK(visible_p_value<BeckmannForms>(BeckmannExact<double>(), kWi, kAlpha) > kSignificance);
}

TEST_CASE(
    "the pair test rejects swapped alphas, normals not weighted by visibility, another "
    "distribution") {
  CHECK(visible_p_value<GgxForms>(Mistaken{swap_alphas}, kWi, kAlpha) < kSignificance);
  CHECK(visible_p_value<GgxForms>(GgxNdf<double>(), kWi, kAlpha) < kSignificance);
  CHECK(visible_p_value<BeckmannForms>(GgxExact<double>(), kWi, kAlpha) < kSignificance);
}

TEST_CASE("the pair test rejects two numbers that depend on each other") {
  const auto dependent = [](Vec3<double>&, Alpha<double>&, double& u1, double& u2) {
    u2 = std::fmod(u1 + u2 / 4, 1.0);
  };
  CHECK(visible_p_value<GgxForms>(Mistaken{dependent}, kWi, kAlpha) < kSignificance);
}

TEST_CASE("the errors of a map are those that were put into it") {
  const auto shifted = [](Vec3<double>&, Alpha<double>&, double& u1, double& u2) {
    u1 = u1 * (1 - 1e-6);
    u2 = u2 * (1 - 1e-7);
  };
  const auto errors = map_errors<GgxForms>(Mistaken{shifted}, kWi, kAlpha);
  CHECK(errors.x == Approx(1e-6).epsilon(1e-3));
  CHECK(errors.y == Approx(1e-7).epsilon(1e-3));
  const auto no_number = [](Vec3<double>&, Alpha<double>& alpha, double&, double&) {
    alpha.x = NAN;
  };
  CHECK(map_errors<GgxForms>(Mistaken{no_number}, direction_at<double>(90), kAlpha).x > 0.5);
}

TEST_CASE("the Kolmogorov distance of a distribution is the one that was put into it") {
  const auto bent = [](Vec3<double>&, Alpha<double>&, double& u1, double&) {
    u1 = u1 + 0.01 * u1 * (1 - u1);
  };
  CHECK(distribution_errors<GgxForms>(Mistaken{bent}, kWi, kAlpha).x ==
        Approx(0.0025).margin(5e-5));
  CHECK(distance_from_uniform({0.25, 0.75}) == 0.25);
  CHECK(distance_from_uniform({0.9, 0.9}) == 0.9);
}

TEST_CASE("the Jacobian notices a density that is off by 1e-5") {
  const auto bent = [](Vec3<double>&, Alpha<double>&, double& u1, double&) { u1 *= 1 + 1e-5; };
  CHECK(jacobian_error(Mistaken{bent}, kWi, kAlpha, 0.3, 0.4) == Approx(1e-5).epsilon(0.01));
  CHECK(jacobian_error(GgxExact<double>(), kWi, kAlpha, 0.3, 0.4) < 1e-7);
}

TEST_CASE("the rounding error is the fraction of pairs that are moved by more than it") {
  const auto moved = [](Vec3<double>&, Alpha<double>&, double& u1, double&) {
    if (u1 < 0.03) u1 += 0.5;
  };
  CHECK(rounding_error<GgxForms>(Mistaken{moved}, GgxExact<double>(), kWi, kAlpha) ==
        Approx(0.03).margin(1e-4));
}

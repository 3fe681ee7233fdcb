// Samplers of all normals, visible or not: azimuth and elevation against closed or integrated CDFs,
// D by quadrature, masking where it is an approximation.
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "support/catch.h"
#include "support/hemisphere_integral.h"
#include "support/visible_normals.h"
#include "vndf/reference/beckmann_ndf.h"
#include "vndf/reference/blinn_phong_ndf.h"
#include "vndf/reference/generalised_trowbridge_reitz_ndf.h"
#include "vndf/reference/ggx_ndf.h"
#include "vndf/reference/walter_roughness.h"

using namespace vndf;
using namespace vndf::test;

namespace {

template <class T>
using Gtr = GeneralisedTrowbridgeReitzNdf<T>;

const std::vector<Alpha<double>> kAlphas{{1, 1}, {0.3, 0.05}, {0.01, 0.01}, {1e-3, 1}, {3, 2}};
const std::vector<double> kGammas{0.1, 0.7, 1, 1.5, 2, 3, 10};

/// The part of the normals that lie below a radius along the azimuth of roughness^2 `a2`, where
/// tan^2(theta) = t.
double beckmann_part(double t, double a2) {
  return -std::expm1(-t / a2);
}
double ggx_part(double t, double a2) {
  return t / (a2 + t);
}
double blinn_phong_part(double t, double a2) {
  return -std::expm1(-std::log1p(t) / a2);
}

/// The same for the generalised distribution from its density, 2 pi D_a cos sin dtheta, by
/// quadrature: with alpha^2 cos^2(theta) + sin^2(theta) = alpha^2 e^v, the mass between v and
/// v + dv is proportional to exp(-(gamma - 1) v) dv.
double gtr_part(double t, double a2, double gamma) {
  const double sin2 = t / (1 + t), excess = (1 - a2) / a2;
  if (excess == 0) return sin2;
  const auto mass = [gamma](double from, double to) {
    return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(
        [gamma](double v) { return std::exp((1 - gamma) * v); }, from, to, 5, 1e-15);
  };
  const double here = std::log1p(sin2 * excess), horizon = std::log1p(excess);
  const double below = mass(0, here);
  return below / (below + mass(here, horizon));
}

/// Probes of u2 for each u1: the quadratures take their time.
constexpr std::size_t kStride = 43;

/// Largest |CDF - u|: x of the azimuth, y of the elevation.
template <class T, class Sampler, class Part>
DistributionErrors polar_errors(const Sampler& sampler, Part part, const Alpha<double>& alpha) {
  const Alpha<T> a{static_cast<T>(alpha.x), static_cast<T>(alpha.y)};
  DistributionErrors worst;
  for_each_probe<T>(
      [&](T u1, T u2) {
        const Vec3<T> m = sampler.sample(Vec3<T>{0, 0, 1}, a, u1, u2);
        const double x = double{m.x} / a.x, y = double{m.y} / a.y;
        const double turn = std::atan2(y, x) / (2 * std::numbers::pi);
        const double horizontal = double{m.x} * m.x + double{m.y} * m.y;
        const double a2 = horizontal / (x * x + y * y);
        const double t = horizontal / (double{m.z} * m.z);
        take_larger(worst, std::abs(std::remainder(turn - double{u1}, 1.0)),
                    std::abs(part(t, a2) - double{u2}));
      },
      kStride);
  return worst;
}

template <class T, class Sampler, class Part>
void check_polar(const Sampler& sampler, Part part, double bound) {
  for (const Alpha<double>& alpha : kAlphas) {
    const DistributionErrors errors = polar_errors<T>(sampler, part, alpha);
    CAPTURE(alpha.x, alpha.y, errors.x, errors.y, bound);
    CHECK(errors.x <= bound);
    CHECK(errors.y <= bound);
  }
}

template <class Sampler>
void check_density(const Sampler& sampler) {
  // Finite differences of a map that turns by 300 where alpha_x / alpha_y is that.
  constexpr double kDifferenceError = 1e-5, kQuadratureError = 1e-6;
  for (const Alpha<double>& alpha : {Alpha<double>{1, 1}, {0.3, 0.05}, {0.01, 0.9}}) {
    CAPTURE(alpha.x, alpha.y);
    CHECK(worst_jacobian_error(sampler, Vec3<double>{0, 0, 1}, alpha) <= kDifferenceError);
  }
  for (const Alpha<double>& alpha : {Alpha<double>{1, 1}, {0.3, 0.1}, {0.05, 0.05}}) {
    CAPTURE(alpha.x, alpha.y);
    const auto pdf = [&](const Vec3<double>& m) { return sampler.pdf({0, 0, 1}, m, alpha); };
    CHECK(over_normals(pdf, {0, 0, 1}, alpha) == Approx(1).margin(kQuadratureError));
  }
}

/// Smith's G1 of isotropic normals at c = cot(theta), by quadrature over s = c e^v of
/// Lambda = 2 / c int s p22(sqrt(c^2 + s^2)) (s - c atan(s / c)) ds.
template <class Sampler>
double integrated_g1(const Sampler& sampler, double alpha, double c) {
  const auto p22 = [&](double r) {
    const double z = 1 / std::hypot(1, r);
    return sampler.d(Vec3<double>{r * z, 0, z}, {alpha, alpha}) * z * z * z * z;
  };
  const auto f = [&](double v) {
    const double e = std::exp(v), s = c * e;
    return 2 * s * s * p22(std::hypot(c, s)) * (e - std::atan(e));
  };
  double sum = 0;
  for (double v = -16; v < 40; v += 2)
    sum += boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, v, v + 2, 3, 1e-11);
  return 1 / (1 + sum);
}

/// The largest error of g1(), with its sign, for theta from 1 to 89 degrees.
template <class Sampler>
double masking_error(const Sampler& sampler, double alpha) {
  double worst = 0;
  for (int degrees = 1; degrees < 90; ++degrees) {
    const auto w = direction_at<double>(degrees);
    const double error = sampler.g1(w, {alpha, alpha}) - integrated_g1(sampler, alpha, w.z / w.x);
    if (std::abs(error) > std::abs(worst)) worst = error;
  }
  return worst;
}

/// A bound that a docstring gives is neither exceeded nor much too large.
void check_bound(double value, double bound) {
  CHECK(value <= bound);
  CHECK(value > 0.9 * bound);
}

}  // namespace

TEST_CASE("azimuth is the quantile of u1 and elevation that of u2, at any anisotropy") {
  check_polar<double>(BeckmannNdf<double>(), beckmann_part, kBeckmannNdfError);
  check_polar<float>(BeckmannNdf<float>(), beckmann_part, kBeckmannNdfFloatError);
  check_polar<double>(GgxNdf<double>(), ggx_part, kGgxNdfError);
  check_polar<float>(GgxNdf<float>(), ggx_part, kGgxNdfFloatError);
  check_polar<double>(BlinnPhongNdf<double>(), blinn_phong_part, BlinnPhongProfile::kError);
  check_polar<float>(BlinnPhongNdf<float>(), blinn_phong_part, BlinnPhongProfile::kFloatError);
}

TEST_CASE("generalised Trowbridge-Reitz: azimuth and elevation are quantiles at any gamma") {
  for (const double gamma : kGammas) {
    const auto part = [gamma](double t, double a2) { return gtr_part(t, a2, gamma); };
    CAPTURE(gamma);
    check_polar<double>(Gtr<double>(GtrProfile(gamma)), part, GtrProfile::kError);
    check_polar<float>(Gtr<float>(GtrProfile(gamma)), part, GtrProfile::kFloatError);
  }
}

TEST_CASE("D of every sampler of normals projects to area 1 and is the density of its samples") {
  check_density(BeckmannNdf<double>());
  check_density(GgxNdf<double>());
  check_density(BlinnPhongNdf<double>());
  for (const double gamma : kGammas) {
    CAPTURE(gamma);
    check_density(Gtr<double>(GtrProfile(gamma)));
  }
}

TEST_CASE("generalised Trowbridge-Reitz at gamma 2 is GGX, D and normals") {
  const Gtr<double> gtr(GtrProfile(2));
  const GgxNdf<double> ggx;
  for (const Alpha<double>& alpha : kAlphas)
    for (const double u : {0.01, 0.3, 0.99}) {
      const auto m = ggx.sample({0, 0, 1}, alpha, 0.7, u), n = gtr.sample({0, 0, 1}, alpha, 0.7, u);
      CAPTURE(alpha.x, alpha.y, u);
      CHECK(std::hypot(m.x - n.x, m.y - n.y, m.z - n.z) < 1e-13);
      CHECK(gtr.d(m, alpha) == Approx(ggx.d(m, alpha)).epsilon(1e-11));
    }
}

TEST_CASE("generalised Trowbridge-Reitz is continuous through gamma 1 and alpha 1") {
  const Vec3<double> m = direction_at<double>(40, 20);
  const Gtr<double> below(GtrProfile(1 - 1e-9)), at(GtrProfile(1)), above(GtrProfile(1 + 1e-9));
  for (const double alpha : {0.01, 1 - 1e-9, 1.0, 1 + 1e-9}) {
    CAPTURE(alpha);
    CHECK(below.d(m, {alpha, alpha}) == Approx(at.d(m, {alpha, alpha})).epsilon(1e-6));
    CHECK(above.d(m, {alpha, alpha}) == Approx(at.d(m, {alpha, alpha})).epsilon(1e-6));
  }
  CHECK(at.d(m, {1, 1}) == Approx(std::numbers::inv_pi).epsilon(1e-14));
}

TEST_CASE("a gamma out of range is an error that names it") {
  for (const double gamma : {0.0, -1.0, 11.0, std::nan("")})
    CHECK_THROWS_WITH(GtrProfile(gamma), contains("gamma"));
}

TEST_CASE("Blinn-Phong: Beckmann's masking errs as stated, on the bright side") {
  const BlinnPhongNdf<double> sampler;
  check_bound(masking_error(sampler, 1), BlinnPhongProfile::kMaskingError);
  check_bound(masking_error(sampler, 0.3), BlinnPhongProfile::kSmoothMaskingError);
  check_bound(masking_error(sampler, 0.1), BlinnPhongProfile::kMirrorMaskingError);
}

TEST_CASE("generalised Trowbridge-Reitz: GGX's masking errs as stated, dark above gamma 2") {
  const auto worst = [](double gamma) {
    double error = 0;
    for (const double alpha : {0.01, 0.05, 0.1, 0.3, 1.0}) {
      const double here = masking_error(Gtr<double>(GtrProfile(gamma)), alpha);
      if (std::abs(here) > std::abs(error)) error = here;
    }
    return error;
  };
  check_bound(worst(1), GtrProfile::kMaskingErrorAt1);
  check_bound(worst(1.5), GtrProfile::kMaskingErrorAt1_5);
  check_bound(-worst(3), GtrProfile::kMaskingErrorAt3);
  CHECK(std::abs(worst(2)) < 1e-9);
}

TEST_CASE("Walter's trick samples at the widened roughness and evaluates at the true one") {
  const GgxNdf<double> inner;
  const WalterRoughness<GgxNdf<double>> sampler;
  const Alpha<double> alpha{0.2, 0.5};
  const auto wi = direction_at<double>(80, 30), wm = direction_at<double>(20, 70);
  const double factor = 1.2 - 0.2 * std::sqrt(wi.z);
  const Alpha<double> wide{factor * alpha.x, factor * alpha.y};
  const auto m = sampler.sample(wi, alpha, 0.3, 0.6), n = inner.sample(wi, wide, 0.3, 0.6);
  CHECK(std::hypot(m.x - n.x, m.y - n.y, m.z - n.z) < 1e-15);
  CHECK(sampler.pdf(wi, wm, alpha) == Approx(inner.d(wm, wide) * wm.z).epsilon(1e-14));
  CHECK(sampler.d(wm, alpha) == inner.d(wm, alpha));
  CHECK(sampler.lambda(wi, alpha) == inner.lambda(wi, alpha));
  CHECK(sampler.g1(wi, alpha) == inner.g1(wi, alpha));
  CHECK(worst_jacobian_error(sampler, wi, alpha) <= 1e-7);
}

TEST_CASE("Walter's trick is none at normal incidence and widens by 1.2 at the horizon") {
  using Walter = WalterRoughness<GgxNdf<double>>;
  CHECK(Walter::widened({0, 0, 1}, {0.5, 2}).x == 0.5);
  CHECK(Walter::widened({1, 0, 0}, {0.5, 2}).y == Approx(2.4));
}

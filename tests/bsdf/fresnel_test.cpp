// Fresnel's equations against Snell's law in complex angles, and their limits.
#include "vndf/bsdf/fresnel.h"

#include <complex>

#include "support/bsdf_inputs.h"
#include "support/catch.h"

using namespace vndf;
using namespace vndf::test;

namespace {

/// The amplitudes of the textbook, in extended precision: r_s = (cos i - n cos t) / (cos i + n cos
/// t) and so on, the angle t complex by Snell's law.
double by_snell(long double c, std::complex<long double> n) {
  const std::complex<long double> t = std::sqrt(1.0L - (1 - c * c) / (n * n));
  const auto s = (c - n * t) / (c + n * t), p = (n * c - t) / (n * c + t);
  return static_cast<double>((std::norm(s) + std::norm(p)) / 2);
}

/// c uniform, or logarithmic towards grazing.
template <class T>
T random_cosine(RandomInputs& random) {
  const double u = random.uniform();
  return static_cast<T>(random.uniform() < 0.3 ? std::pow(10, -8 * u) : u);
}

template <class T>
void check_dielectric() {
  RandomInputs random(1);
  for (int i = 0; i < 100000; ++i) {
    const T eta = static_cast<T>(std::pow(10, 2 * random.uniform() - 1)),
            c = random_cosine<T>(random);
    const long double square = (eta - 1.0L) * (eta + 1.0L) + static_cast<long double>(c) * c;
    const double exact = square < 0 ? 1 : by_snell(c, eta);
    const double g = std::sqrt(std::abs(static_cast<double>(square)));
    const double bound =
        std::min<double>(kFresnelError<T> / std::min(1.0, g), kFresnelErrorAtCriticalAngle<T>);
    CAPTURE(eta, c, g);
    REQUIRE((fresnel_dielectric(c, eta) >= 0 && fresnel_dielectric(c, eta) <= 1));
    REQUIRE(std::abs(double{fresnel_dielectric(c, eta)} - exact) <= bound);
  }
}

template <class T>
void check_conductor() {
  RandomInputs random(2);
  for (int i = 0; i < 100000; ++i) {
    const ComplexIndex<T> index{static_cast<T>(std::pow(10, 2 * random.uniform() - 1)),
                                static_cast<T>(std::pow(10, 2 * random.uniform() - 1))};
    const T c = random_cosine<T>(random);
    CAPTURE(index.eta, index.k, c);
    REQUIRE(std::abs(double{fresnel_conductor(c, index)} - by_snell(c, {index.eta, index.k})) <=
            kFresnelError<T>);
  }
}

}  // namespace

TEST_CASE("the reflectance of dielectrics and conductors is Fresnel's to the stated error") {
  check_dielectric<float>();
  check_dielectric<double>();
  check_conductor<float>();
  check_conductor<double>();
}

TEST_CASE("at normal incidence the reflectance is |(n - 1) / (n + 1)|^2") {
  for (const double eta : {0.2, 0.66, 1.0, 1.33, 1.5, 2.4}) {
    const double exact = std::norm((eta - 1) / (eta + 1));
    CHECK(fresnel_dielectric(1.0, eta) == Approx(exact).margin(1e-15));
    CHECK(fresnel_conductor(1.0, {eta, 0.0}) == Approx(exact).margin(1e-15));
    const std::complex<double> n(eta, 3.0);
    CHECK(fresnel_conductor(1.0, {eta, 3.0}) == Approx(std::norm((n - 1.0) / (n + 1.0))));
  }
}

TEST_CASE("at grazing everything is reflected, with the slope of the cosine") {
  for (const double eta : {0.66, 1.33, 1.5}) {
    CHECK(fresnel_dielectric(0.0, eta) == Approx(1).margin(kFresnelError<double>));
    CHECK(fresnel_conductor(0.0, {eta, 2.0}) == Approx(1).margin(kFresnelError<double>));
    CHECK(fresnel_conductor(0.0, {eta, 0.0}) == Approx(1).margin(kFresnelError<double>));
  }
  // 1 - F = 2 c (eta^2 + 1) / sqrt(eta^2 - 1) + O(c^2)
  const double c = 1e-7, eta = 1.5;
  const double slope = 2 * (eta * eta + 1) / std::sqrt(eta * eta - 1);
  CHECK((1 - fresnel_dielectric(c, eta)) / c == Approx(slope).epsilon(1e-5));
}

TEST_CASE("at Brewster's angle half of the s part is reflected and nothing of the p part") {
  const double eta = 1.5, c = 1 / std::hypot(1, eta);
  const double s = (1 - eta * eta) / (1 + eta * eta);
  CHECK(fresnel_dielectric(c, eta) == Approx(s * s / 2));
}

TEST_CASE("beyond the critical angle everything is reflected") {
  const double eta = 1 / 1.5, critical = std::sqrt(1 - eta * eta);
  CHECK(fresnel_dielectric(critical * 0.999, eta) == 1);
  CHECK(fresnel_dielectric(0.0, eta) == 1);
  CHECK(fresnel_dielectric(critical * 1.001, eta) < 0.9);
}

TEST_CASE("light meets the same reflectance from either side") {
  for (const double c : {1.0, 0.9, 0.5, 0.1}) {
    const double far = std::sqrt(squared_far_cosine(c, 1.5)) / 1.5;
    CHECK(fresnel_dielectric(c, 1.5) == Approx(fresnel_dielectric(far, 1 / 1.5)));
  }
}

TEST_CASE("an interface between equal indices reflects nothing at any angle") {
  for (const double c : {0.0, 1e-30, 1e-8, 0.5, 1.0}) {
    CHECK(fresnel_dielectric(c, 1.0) == 0);
    CHECK(fresnel_conductor(c, {1.0, 0.0}) == Approx(0).margin(1e-15));
  }
}

TEST_CASE("a conductor without absorption is a dielectric") {
  for (const double eta : {0.66, 1.1, 1.5, 3.0})
    for (const double c : {0.0, 1e-6, 0.1, 0.5, 0.9, 1.0})
      CHECK(fresnel_conductor(c, {eta, 0.0}) == Approx(fresnel_dielectric(c, eta)).margin(1e-14));
}

TEST_CASE("each channel of a metal has its own index, and a perfect mirror reflects 1") {
  const ConductorFresnel gold{{0.14, 0.37, 1.44}, {4.1, 2.3, 1.8}};
  const auto f = gold(0.7);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(f[i] == fresnel_conductor(0.7, {gold.eta[i], gold.k[i]}));
  CHECK(PerfectMirror<double>{}(0.3)[0] == 1);
}

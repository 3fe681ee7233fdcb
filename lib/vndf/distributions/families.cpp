// The named slope distributions: densities and closed forms without cancellation.
#include "vndf/distributions/families.h"

#include <algorithm>
#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "vndf/support/text.h"

namespace vndf::distributions {
namespace {

using std::numbers::inv_pi;
using std::numbers::inv_sqrtpi;
using std::numbers::sqrt3;

/// Returns `value` if it is finite and `valid`.
double checked(double value, bool valid, const std::string& what, const std::string& rule) {
  if (valid && std::isfinite(value)) return value;
  throw std::invalid_argument(what + " is " + support::number_text(value) + "; it must be " + rule);
}

double checked_tail(double value, const std::string& what) {
  return checked(value, value > 1.5, what,
                 "> 3/2, for smaller ones have an infinite mean slope and no masking function");
}

/// exp(-x^2) to one unit in the last place: the rounding of x^2 alone would cost x^2 units.
double gaussian(double x) {
  const double square = x * x;
  const double value = std::exp(-square);
  return value == 0 ? 0 : value * (1 - std::fma(x, x, -square));
}

/// (1 + u^2)^e without overflow of u^2, to about e units in the last place.
double power_of_square(double u, double e) {
  return u < 1 ? std::exp(e * std::log1p(u * u)) : std::pow(std::hypot(1, u), 2 * e);
}

/// Gamma(a + 1/2) / Gamma(a).
double half_gamma_step(double a) {
  return 1 / boost::math::tgamma_delta_ratio(a, 0.5);
}

}  // namespace

double Beckmann::p22(double r) const {
  return std::exp(-r * r) * inv_pi;
}

std::optional<Marginals> Beckmann::marginals(double x) const {
  const double p = gaussian(x) * inv_sqrtpi;
  return Marginals{p, std::erfc(x) / 2, p / 2};
}

double Ggx::p22(double r) const {
  const double square = 1 + r * r;
  return inv_pi / (square * square);
}

std::optional<Marginals> Ggx::marginals(double x) const {
  const double h = std::hypot(1, x);
  return Marginals{0.5 / h / h / h, 0.5 / h / (h + x), 0.5 / h};
}

PowerLaw::PowerLaw(double g, double s)
    : g_(g),
      scale_(std::sqrt(s)),
      at_zero_((g - 1) * inv_pi / s),
      top_(half_gamma_step(g - 1) * inv_sqrtpi / scale_) {}

double PowerLaw::p22(double r) const {
  return at_zero_ * power_of_square(r / scale_, -g_);
}

double PowerLaw::density(double x) const {
  return top_ * power_of_square(x / scale_, 0.5 - g_);
}

std::optional<Marginals> PowerLaw::marginals(double x) const {
  constexpr double kFar = 1e8;  // from here on P is a power to the last digit
  const double u = x / scale_, square = u * u;
  const double p = density(x);
  const double m = top_ * scale_ * scale_ / (2 * g_ - 3) * power_of_square(u, 1.5 - g_);
  if (u > kFar) return Marginals{p, p * x / (2 * g_ - 2), m};
  const double twice_q = square < 1 ? boost::math::ibetac(0.5, g_ - 1, square / (1 + square))
                                    : boost::math::ibeta(g_ - 1, 0.5, 1 / (1 + square));
  return Marginals{p, twice_q / 2, m};
}

StudentT::StudentT(double gamma)
    : PowerLaw(checked_tail(gamma, "student-t: gamma"), gamma - 1), gamma_(gamma) {}

std::string StudentT::name() const {
  return "student-t:gamma=" + support::number_text(gamma_);
}

HyperCauchy::HyperCauchy(double q) : PowerLaw(checked_tail(q, "hyper-cauchy: q"), 2), q_(q) {}

std::string HyperCauchy::name() const {
  return "hyper-cauchy:q=" + support::number_text(q_);
}

BlinnPhong::BlinnPhong(double n)
    : PowerLaw(checked(n, n > -1, "blinn-phong: n",
                       "> -1, for smaller ones have an infinite mean slope and no masking "
                       "function") /
                       2 +
                   2,
               1),
      n_(n) {}

std::string BlinnPhong::name() const {
  return "blinn-phong:n=" + support::number_text(n_);
}

namespace {

/// k with p = 2^k, or -1: squaring is ten times faster than a power of any exponent.
int squarings_for(double p) {
  int exponent = 0;
  return std::frexp(p, &exponent) == 0.5 && exponent >= 1 ? exponent - 1 : -1;
}

}  // namespace

ExponentialPower::ExponentialPower(double p)
    : p_(checked(p, p > 0, "exponential-power: p", "> 0")),
      squarings_(squarings_for(p)),
      log_factor_(std::log(p / 2 * inv_pi) - boost::math::lgamma(2 / p)) {}

std::string ExponentialPower::name() const {
  return "exponential-power:p=" + support::number_text(p_);
}

double ExponentialPower::p22(double r) const {
  double power = r;
  for (int k = 0; k < squarings_; ++k) power *= power;
  return std::exp(log_factor_ - (squarings_ < 0 ? std::pow(r, p_) : power));
}

std::optional<Marginals> ExponentialPower::marginals(double x) const {
  if (p_ == 2) return Beckmann().marginals(x);
  return {};
}

KDistribution::KDistribution(double nu)
    : nu_(checked(nu, nu > 0 && nu <= 100, "k: nu",
                  "> 0 and <= 100, for larger ones are Beckmann's distribution within 1 %")),
      factor_(2 * nu * inv_pi / boost::math::tgamma(nu)) {}

std::string KDistribution::name() const {
  return "k:nu=" + support::number_text(nu_);
}

namespace {

/// (z/2)^order K_order(z), |order| <= 2.
double scaled_bessel(double order, double z) {
  using namespace boost::math::policies;
  // A power costs as much as the Bessel function: nu = 3 does without.
  const double power = order == 2 ? z * z / 4 : std::pow(z / 2, order);
  return power * boost::math::cyl_bessel_k(std::abs(order), z, policy<promote_double<false>>());
}

/// 2 (z/2)^order K_order(z) / Gamma(order), 1 at z = 0, for order > 2: neither the power nor
/// K can overflow in the recurrence K_{n+1} = K_{n-1} + (2 n / z) K_n written for this ratio.
double bessel_ratio(double order, double z) {
  double n = order - std::ceil(order) + 2;  // in (1, 2]
  double previous = 2 * scaled_bessel(n - 1, z) / boost::math::tgamma(n - 1);
  double current = 2 * scaled_bessel(n, z) / boost::math::tgamma(n);
  const double quarter = z * z / 4;
  for (; n < order - 0.5; ++n) {
    const double next = current + quarter * previous / (n * (n - 1));
    previous = current;
    current = next;
  }
  return current;
}

}  // namespace

double KDistribution::p22(double r) const {
  constexpr double kSmallest = 1e-300, kNegligible = 1e-100, kLargest = 700;
  const double order = nu_ - 1;
  const double z = std::max(2 * std::sqrt(nu_) * r, kSmallest);
  if (z > kLargest) return 0;  // below 1e-200
  if (order >= 1 && z < kNegligible) return nu_ * inv_pi / order;
  if (order > 2) return nu_ * inv_pi / order * bessel_ratio(order, z);
  if (r == 0) return order > 0 ? nu_ * inv_pi / order : std::numeric_limits<double>::infinity();
  return std::min(factor_ * scaled_bessel(order, z), std::numeric_limits<double>::max());
}

std::optional<Marginals> KDistribution::marginals(double x) const {
  if (nu_ == 1) {
    const double e = std::exp(-2 * x);
    return Marginals{e, e / 2, e == 0 ? 0 : e * (2 * x + 1) / 4};
  }
  if (nu_ != 3) return {};
  constexpr double kSqrt3Rest = 1.0035084221806903e-16;  // sqrt(3) - its double
  const double z = 2 * sqrt3 * x;
  const double rounding = std::fma(2 * sqrt3, x, -z) + 2 * kSqrt3Rest * x;
  const double e = std::exp(-z) * (1 - rounding);
  if (std::exp(-z) == 0) return Marginals{0, 0, 0};
  return Marginals{sqrt3 / 8 * ((z + 3) * z + 3) * e, ((z + 5) * z + 8) * e / 16,
                   sqrt3 / 96 * (((z + 6) * z + 15) * z + 15) * e};
}

PearsonII::PearsonII(double m)
    : m_(checked(m, m >= -0.5, "pearson-ii: m",
                 ">= -1/2, for the marginal density of smaller ones is infinite at the rim")),
      top_(half_gamma_step(m + 1.5) * inv_sqrtpi) {}

std::string PearsonII::name() const {
  return "pearson-ii:m=" + support::number_text(m_);
}

double PearsonII::p22(double r) const {
  return r < 1 ? (m_ + 1) * inv_pi * std::pow((1 - r) * (1 + r), m_) : 0;
}

std::optional<Marginals> PearsonII::marginals(double x) const {
  if (x >= 1) return Marginals{0, 0, 0};
  const double square = x * x, rest = (1 - x) * (1 + x);
  const auto power = [&](double e) {
    return x < 0.5 ? std::exp(e * std::log1p(-square)) : std::pow(rest, e);
  };
  const double twice_q = square < 0.5 ? boost::math::ibetac(0.5, m_ + 1.5, square)
                                      : boost::math::ibeta(m_ + 1.5, 0.5, rest);
  return Marginals{top_ * power(m_ + 0.5), twice_q / 2, top_ / (2 * m_ + 3) * power(m_ + 1.5)};
}

Annulus::Annulus(double inner)
    : inner_(checked(inner, inner >= 0 && inner < 1, "annulus: inner", ">= 0 and < 1")),
      area_((1 - inner) * (1 + inner)) {}

std::string Annulus::name() const {
  return "annulus:inner=" + support::number_text(inner_);
}

double Annulus::p22(double r) const {
  return r >= inner_ && r < 1 ? inv_pi / area_ : 0;
}

std::vector<double> Annulus::breaks() const {
  return inner_ > 0 ? std::vector<double>{inner_, 1} : std::vector<double>{1};
}

namespace {

/// a - sin(a) for 0 <= a <= pi / 2, by its series where the difference would cancel: the first
/// term left out is below 1e-19 of the sum.
double minus_sine(double a) {
  if (a > 0.5) return a - std::sin(a);
  const double square = a * a;
  double sum = 1;
  for (int n = 14; n >= 4; n -= 2) sum = 1 - square / (n * (n + 1)) * sum;
  return a * square / 6 * sum;
}

}  // namespace

std::optional<Marginals> Annulus::marginals(double x) const {
  if (x >= inner_) {
    const Marginals disk = *UniformDisk().marginals(x);
    return Marginals{disk.p / area_, disk.q / area_, disk.m / area_};
  }
  // u and v are half the chords of the outer and the inner circle at x, and `angle` lies between
  // their ends. Differences of the two disks are written with u - v = (1 - inner^2) / (u + v) and
  // inner sin(angle) = x (u - v).
  const double u = std::sqrt((1 - x) * (1 + x)), v = std::sqrt((inner_ - x) * (inner_ + x));
  const double sum = u + v;
  const double angle = std::atan2(x * area_ / sum, x * x + u * v);
  const double q = std::atan2(v, x) + std::sin(angle) / (1 + inner_) + minus_sine(angle) / area_;
  return Marginals{2 * inv_pi / sum, q * inv_pi, 2 * inv_pi / 3 * (u * u + u * v + v * v) / sum};
}

double Volcano::p22(double r) const {
  const double e = std::exp(-r * r) * inv_pi;
  return e == 0 ? 0 : r * r * e;
}

std::optional<Marginals> Volcano::marginals(double x) const {
  const double e = gaussian(x) * inv_sqrtpi;
  if (e == 0) return Marginals{0, 0, 0};
  return Marginals{(x * x + 0.5) * e, std::erfc(x) / 2 + x * e / 2, (x * x / 2 + 0.75) * e};
}

}  // namespace vndf::distributions

// Beckmann and GGX in closed form: references for the builder, which knows p22 alone.
// Sources: Heitz and d'Eon 2014, supplemental 1; Walter et al. 2007 for Lambda.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

namespace vndf::test {

struct BeckmannForms {
  static constexpr const char* name = "beckmann";
  static double p(double x) { return std::exp(-x * x) * std::numbers::inv_sqrtpi; }
  static double q(double x) { return std::erfc(x) / 2; }
  static double m(double x) { return std::exp(-x * x) * std::numbers::inv_sqrtpi / 2; }
  static double lambda(double c) { return m(c) / c - q(c); }
  static double d(double cos_theta) {
    const double square = cos_theta * cos_theta;
    return std::exp(-(1 - square) / square) * std::numbers::inv_pi / (square * square);
  }
  /// P(Y <= y | x).
  static double conditional(double, double y) { return std::erfc(-y) / 2; }
  static double mean_slope() { return std::numbers::inv_sqrtpi; }
};

struct GgxForms {
  static constexpr const char* name = "ggx";
  static double p(double x) { return std::pow(1 + x * x, -1.5) / 2; }
  static double q(double x) {
    const double h = std::hypot(1, x);
    return x < 0 ? 1 - q(-x) : 1 / (2 * h * (h + x));
  }
  static double m(double x) { return 1 / (2 * std::hypot(1, x)); }
  static double lambda(double c) { return 1 / (2 * c * (c + std::hypot(1, c))); }
  static double d(double) { return std::numbers::inv_pi; }
  static double conditional(double x, double y) {
    const double s = y / std::hypot(1, x);
    if (s < 0) return 1 - conditional(x, -y);
    return 0.5 + (s / (1 + s * s) + std::atan(s)) * std::numbers::inv_pi;
  }
  static double mean_slope() { return 1; }
};

/// CDF of the visible marginal slope x <= cot(theta).
template <class Forms>
double visible_cdf(double cosine, double sine, double x) {
  const double c = sine > 0 ? cosine / sine : std::numeric_limits<double>::infinity();
  const auto mass = [&](double at) {
    return cosine * (1 - Forms::q(at)) + sine * (std::isinf(at) ? 0 : Forms::m(at));
  };
  return mass(x < c ? x : c) / mass(c);
}

}  // namespace vndf::test

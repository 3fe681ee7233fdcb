// Samplers for tests of the validator: exact ones, and exact ones with one mistake each. They
// compute in double precision and return T, so that rounding is the only error of the exact ones.
#pragma once

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "support/closed_forms.h"
#include "vndf/distributions/parse_distribution.h"
#include "vndf/tabulated_sampler.h"
#include "vndf/validate/exact/exact_distribution.h"

namespace vndf::test {

/// The exact slopes of a specification.
inline std::shared_ptr<const validate::ExactSlopes> exact_slopes(const std::string& specification) {
  return std::make_shared<validate::ExactSlopes>(distributions::parse_distribution(specification));
}

/// The functions of a sampler in closed form.
template <class T, class Forms>
class ClosedFunctions {
 public:
  using Scalar = T;
  static constexpr bool kVisible = true;

  T d(const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    if (!(wm.z > T(0))) return T(0);
    const double z = wm.z, x = wm.x / double{alpha.x}, y = wm.y / double{alpha.y};
    const double stretched = std::hypot(x, y, z);
    const double ratio = z / stretched;
    // D of the stretched normal; the Jacobian of the stretch is (z / ratio)^-4 / (ax ay).
    return static_cast<T>(Forms::d(ratio) / (double{alpha.x} * alpha.y * std::pow(stretched, 4)));
  }
  T lambda(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    const double s = std::hypot(double{alpha.x} * w.x, double{alpha.y} * w.y);
    return s == 0 ? T(0) : static_cast<T>(Forms::lambda(std::abs(double{w.z}) / s));
  }
  T g1(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    return w.z == T(0) ? T(0) : T(1) / (T(1) + lambda(w, alpha));
  }
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    const double s = std::hypot(double{alpha.x} * wi.x, double{alpha.y} * wi.y);
    const double c = wi.z / s;  // wi.z Lambda = s (M(c) - c Q(c)), finite at the horizon
    const double hidden = s == 0 ? 0 : s * (Forms::m(c) - c * Forms::q(c));
    const double cosine = std::max(0.0, static_cast<double>(dot(wi, wm)));
    return static_cast<T>(cosine * d(wm, alpha) / (wi.z + hidden));
  }
};

/// GGX by spherical caps (Dupuy and Benyoub 2023): an exact distribution whose map is not monotone.
/// `Turn` gives the azimuth in the cap.
struct FullTurn {
  static double phi(double u) { return 2 * std::numbers::pi * u; }
};
/// The mistake 2 / pi for 2 pi, on one branch.
struct BrokenTurn {
  static double phi(double u) {
    return u < 0.5 ? 2 * std::numbers::pi * u : 2 / std::numbers::pi * u;
  }
};

template <class T, class Turn = FullTurn>
class CapsGgx : public ClosedFunctions<T, GgxForms> {
 public:
  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    const double ax = alpha.x, ay = alpha.y;
    const Vec3<double> w = normalize_or_up(Vec3<double>{ax * wi.x, ay * wi.y, double{wi.z}});
    // Height over the lower end of the cap, where the normal would be the difference of equals.
    const double above = std::max(1e-8, 1 - double{u2}) * (1 + w.z);
    const double z = above - w.z;
    const double s = std::sqrt(std::clamp(1 - z * z, 0.0, 1.0)), phi = Turn::phi(u1);
    const Vec3<double> m = normalize_or_up(
        Vec3<double>{ax * (s * std::cos(phi) + w.x), ay * (s * std::sin(phi) + w.y), above});
    return {static_cast<T>(m.x), static_cast<T>(m.y), static_cast<T>(m.z)};
  }
};

/// Beckmann by root result on its closed CDF: the monotone inverse map.
template <class T>
class InverseBeckmann : public ClosedFunctions<T, BeckmannForms> {
 public:
  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    const double ax = alpha.x, ay = alpha.y, wx = ax * wi.x, wy = ay * wi.y;
    const double s = std::hypot(wx, wy), cosine = s > 0 ? wx / s : 1, sine = s > 0 ? wy / s : 0;
    const double x = slope_x(wi.z, s, u1), y = slope_y(u2);
    const Vec3<double> m = normalize_or_up(
        Vec3<double>{-ax * (cosine * x - sine * y), -ay * (sine * x + cosine * y), 1});
    return {static_cast<T>(m.x), static_cast<T>(m.y), static_cast<T>(m.z)};
  }

 private:
  static constexpr double kFarthest = 20;  // Beckmann slopes beyond have no probability

  static double slope_y(double u) {
    if (u <= 0 || u >= 1) return u <= 0 ? -kFarthest : kFarthest;
    return u < 0.5 ? -boost::math::erfc_inv(2 * u) : boost::math::erfc_inv(2 * (1 - u));
  }
  /// Bisection on the mass below, or for u > 1/2 on the mass above, which keeps its digits.
  static double slope_x(double z, double s, double u) {
    const double c = s > 0 ? z / s : kFarthest, end = std::min(c, kFarthest);
    const auto below = [&](double x) { return z * BeckmannForms::q(-x) + s * BeckmannForms::m(x); };
    const double all = below(end);
    double low = -kFarthest, high = end;
    for (int k = 0; k < 60; ++k) {
      const double x = (low + high) / 2;
      const double above = z * (BeckmannForms::q(x) - BeckmannForms::q(end)) -
                           s * (BeckmannForms::m(x) - BeckmannForms::m(end));
      const bool left = u < 0.5 ? below(x) < u * all : above > (1 - u) * all;
      (left ? low : high) = x;
    }
    return (low + high) / 2;
  }
};

/// A tabulated sampler with one mistake in what surrounds its tables.
template <class T>
class Wrapped {
 public:
  using Scalar = T;
  static constexpr bool kVisible = true;
  explicit Wrapped(std::shared_ptr<const SlopeTables> tables) : good_(std::move(tables)) {}

  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    return good_.sample(wi, alpha, u1, u2);
  }
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    return good_.pdf(wi, wm, alpha);
  }
  T d(const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept { return good_.d(wm, alpha); }
  T lambda(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    return good_.lambda(w, alpha);
  }
  T g1(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept { return good_.g1(w, alpha); }

 protected:
  TabulatedSampler<T> good_;
};

template <class T>
class AlphaXForAlphaY : public Wrapped<T> {
 public:
  using Wrapped<T>::Wrapped;
  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    return this->good_.sample(wi, {alpha.x, alpha.x}, u1, u2);
  }
};

template <class T>
class PdfWithoutG1 : public Wrapped<T> {
 public:
  using Wrapped<T>::Wrapped;
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    return std::max(T(0), dot(wi, wm)) * this->good_.d(wm, alpha) / wi.z;
  }
};

/// No stretched slope larger than 16.
template <class T>
class TailCut : public Wrapped<T> {
 public:
  using Wrapped<T>::Wrapped;
  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    const Vec3<T> m = this->good_.sample(wi, alpha, u1, u2);
    const T x = m.x / alpha.x, y = m.y / alpha.y, slope = std::sqrt(x * x + y * y) / m.z;
    if (!(slope > T(16))) return m;
    const T cut = T(16) / slope;
    return normalize_or_up(Vec3<T>{m.x * cut, m.y * cut, m.z});
  }
};

/// Lambda 0.3 % too large, as in a rational fit that renderers use, and all that is made of it.
template <class T>
class LambdaOff : public Wrapped<T> {
 public:
  using Wrapped<T>::Wrapped;
  T lambda(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    return T(1.003) * this->good_.lambda(w, alpha);
  }
  T g1(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    return T(1) / (T(1) + lambda(w, alpha));
  }
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    const T good = this->good_.lambda(wi, alpha);
    const T ratio = std::isinf(good) ? T(1.003) : (T(1) + lambda(wi, alpha)) / (T(1) + good);
    return this->good_.pdf(wi, wm, alpha) / ratio;
  }
};

/// `tables` with marginal rows taken at `place(row coordinate)` of the good ones.
template <class Place>
std::shared_ptr<const SlopeTables> with_rows_at(const SlopeTables& tables, Place place) {
  const QuantileTable& good = tables.marginal;
  std::vector<float> values;
  for (std::size_t i = 0; i < good.rows(); ++i)
    for (std::size_t j = 0; j < good.columns(); ++j)
      values.push_back(static_cast<float>(
          good.lookup(place(static_cast<double>(i) / static_cast<double>(good.rows() - 1)),
                      static_cast<double>(j) / static_cast<double>(good.columns() - 1))));
  SlopeTables changed = tables;
  changed.marginal = QuantileTable(good.rows(), good.columns(), values);
  return share(std::move(changed));
}

}  // namespace vndf::test

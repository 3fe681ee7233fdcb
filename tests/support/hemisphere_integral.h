// int f(m) dm over the upper hemisphere, by Gauss-Kronrod quadrature over stretched slopes.
#pragma once

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "vndf/vec.h"

namespace vndf::test {

/// int g(t) dt over [0, 2 pi], split at `breaks`.
template <class G>
double over_azimuths(G g, const std::vector<double>& breaks) {
  using Rule = boost::math::quadrature::gauss_kronrod<double, 21>;
  double sum = 0, from = 0;
  for (const double to : breaks) {
    sum += Rule::integrate(g, from, to, 0);
    from = to;
  }
  return sum;
}

/// The slope of m along the azimuth phi is alpha times r: dm = m.z^3 alpha_x alpha_y r dr dphi.
/// The radius runs over exp(v), of which the integrand vanishes at both ends, and is split where
/// facets turn away from `wi`, so that f may have a kink there.
template <class F>
double over_normals(F f, const Vec3<double>& wi, const Alpha<double>& alpha) {
  using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
  std::vector<double> breaks;
  for (int k = 1; k <= 16; ++k) breaks.push_back(k * std::numbers::pi / 8);
  return over_azimuths(
      [&](double phi) {
        const double cx = alpha.x * std::cos(phi), cy = alpha.y * std::sin(phi);
        const auto ring = [&](double v) {
          const double r = std::exp(v), z = 1 / std::sqrt(1 + r * r * (cx * cx + cy * cy));
          return f(Vec3<double>{cx * r * z, cy * r * z, z}) * z * z * z * r * r;
        };
        // dot(wi, m) = 0 at r = -wi.z / (wi.x cx + wi.y cy)
        const double lean = -(wi.x * cx + wi.y * cy);
        const double kink = lean > 0 && wi.z > 0 ? std::log(wi.z / lean) : 0;
        constexpr double kEnd = 24, kStep = 4;
        double sum = 0;
        for (double from = -kEnd; from < kEnd; from += kStep) {
          const double to = from + kStep;
          if (kink > from && kink < to)
            sum += Rule::integrate(ring, from, kink, 2, 1e-10) +
                   Rule::integrate(ring, kink, to, 2, 1e-10);
          else
            sum += Rule::integrate(ring, from, to, 2, 1e-10);
        }
        return sum * alpha.x * alpha.y;
      },
      breaks);
}

}  // namespace vndf::test

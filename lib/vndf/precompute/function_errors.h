// Measures D, Lambda and pdf of a sampler against the exact functions, for any sampler. A renderer
// weights its samples with these, so that their errors become errors of brightness.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "vndf/certificate.h"
#include "vndf/precompute/map_errors.h"
#include "vndf/precompute/unit_slopes.h"
#include "vndf/support/low_discrepancy.h"
#include "vndf/support/parallel.h"
#include "vndf/vec.h"

namespace vndf::precompute {

/// `Sampler`, in single precision, at unit roughness. Both arguments must outlive this object.
template <class Sampler>
class FunctionErrors {
 public:
  FunctionErrors(const UnitSlopes& slopes, const Sampler& sampler)
      : slopes_(slopes), sampler_(sampler) {}

  /// Sets max_d_error, max_lambda_error and max_pdf_error of `certificate`.
  void measure(Certificate& certificate, const support::Workers& workers) const {
    const double farthest = farthest_slope();
    certificate.max_d_error = largest(workers, [&](std::size_t k) {
      const double root = support::golden(k);  // squared, the radii crowd where D may have a pole
      return d_error(std::sinh(farthest * root * root));
    });
    std::vector<double> area(kPoints, 0), pdf(kPoints, 0);
    support::parallel_for(kPoints, workers, [&](std::size_t k) {
      for (const int side : {1, -1}) {
        const Vec3<float> wi = direction(k, side);
        const double exact = exact_area(wi);  // an integral, which takes most of the time
        if (exact < kLeastArea) continue;
        area[k] = std::max(area[k], error_or_largest(area_error(wi, exact)));
        pdf[k] = std::max(pdf[k], error_or_largest(pdf_error(wi, exact, k)));
      }
    });
    certificate.max_lambda_error = *std::max_element(area.begin(), area.end());
    certificate.max_pdf_error = *std::max_element(pdf.begin(), pdf.end());
  }

 private:
  static constexpr std::size_t kPoints = 4000;  // of each function
  // D is measured where at least this is left of the partial moment of slopes beyond.
  static constexpr double kNdfTail = 1e-12;

  /// asinh of the radius up to which D is measured.
  double farthest_slope() const {
    double farthest = 0;
    while (slopes_.m(farthest) > kNdfTail && farthest < 16) farthest += 0.01;
    return farthest;
  }

  double d_error(double r) const {
    const double length = std::hypot(1, r * slopes_.mean_slope());
    const Vec3<float> wm{static_cast<float>(-r * slopes_.mean_slope() / length), 0,
                         static_cast<float>(1 / length)};
    const double exact = exact_d(wm), given = double{sampler_.d(wm, {1, 1})};
    return exact > 0 ? std::abs(given / exact - 1) : given;
  }

  double exact_d(const Vec3<float>& wm) const {
    const double z = wm.z, mu = slopes_.mean_slope();
    const double radius = std::hypot(double{wm.x}, double{wm.y}) / (z * mu);
    return slopes_.p22(radius) / (mu * mu * z * z * z * z);
  }

  /// Direction k of a sequence, above the horizon or, for side -1, below it.
  static Vec3<float> direction(std::size_t k, int side) {
    const double theta = std::numbers::pi / 2 * support::golden(k);
    return {static_cast<float>(std::sin(theta)), 0, static_cast<float>(side * std::cos(theta))};
  }

  /// The projected area of the facets that face w.
  double exact_area(const Vec3<float>& w) const {
    const double horizontal = slopes_.mean_slope() * std::hypot(double{w.x}, double{w.y});
    const double away = horizontal * slopes_.backfacing(std::abs(w.z) / horizontal).value;
    return std::max(0.0, double{w.z}) + away;
  }

  double area_error(const Vec3<float>& w, double exact) const {
    return std::abs(double{sampler_.visible_area(w, {1, 1})} / exact - 1);
  }

  /// The error is relative to the density that the normal would have if it faced wi, because near
  /// the edge of visibility dot(wi, wm) has only absolute precision.
  double pdf_error(const Vec3<float>& wi, double area, std::size_t k) const {
    const Vec3<float> wm = sampler_.sample(wi, {1, 1}, static_cast<float>(support::golden(k * 3)),
                                           static_cast<float>(support::golden(k * 7, 0.125)));
    const double cosine = double{wi.x} * wm.x + double{wi.y} * wm.y + double{wi.z} * wm.z;
    const double facing = exact_d(wm) / area;
    const double error = double{sampler_.pdf(wi, wm, {1, 1})} - std::max(0.0, cosine) * facing;
    return facing > 0 ? std::abs(error) / facing : std::abs(error);
  }

  template <class F>
  static double largest(const support::Workers& workers, F error) {
    std::vector<double> errors(kPoints);
    support::parallel_for(kPoints, workers,
                          [&](std::size_t i) { errors[i] = error_or_largest(error(i)); });
    return *std::max_element(errors.begin(), errors.end());
  }

  const UnitSlopes& slopes_;
  const Sampler& sampler_;
};

}  // namespace vndf::precompute

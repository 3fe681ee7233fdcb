// Density check: pdf() and the functions that it is made of.
#include "vndf/validate/checks/density_check.h"

#include <algorithm>
#include <cmath>

#include "vndf/validate/checks/configurations.h"
#include "vndf/validate/checks/worst_over.h"
#include "vndf/validate/exact/normal_quadrature.h"
#include "vndf/validate/statistics/density_distance.h"
#include "vndf/validate/statistics/quasi_random.h"

namespace vndf::validate {
namespace {

constexpr const char* kCheck = "density";
constexpr std::size_t kNormals = 2000;     // sampled normals of each configuration
constexpr std::size_t kDerivatives = 300;  // places of the map's derivative

struct DensityErrors {
  Worst integral, pdf, d, lambda, g1, jacobian;

  void see(const DensityErrors& o) {
    see_each(std::tie(integral, pdf, d, lambda, g1, jacobian),
             std::tie(o.integral, o.pdf, o.d, o.lambda, o.g1, o.jacobian));
  }
};

/// Measures all errors at one configuration.
class DensityCheck {
 public:
  DensityCheck(const SamplerUnderTest& sampler, const Configuration& c)
      : sampler_(sampler),
        c_(c),
        surface_(c.surface()),
        distribution_(*sampler.exact, sampler.claims.normals, c) {}

  DensityErrors measure() {
    measure_integral();
    measure_normals();
    measure_shadowing();
    if (sampler_.claims.inverse_at(c_)) measure_sampled_density();
    return errors_;
  }

 private:
  void measure_integral() {
    const auto nodes = normal_quadrature(*sampler_.exact, sampler_.claims.normals, c_);
    std::vector<double> pdf(nodes.wm.size());
    sampler_.pdf(c_, nodes.wm, pdf);
    double sum = 0;
    for (std::size_t k = 0; k < pdf.size(); ++k) sum += pdf[k] * nodes.weight[k];
    errors_.integral.see(std::abs(sum - nodes.covered), place_of(c_));
  }

  void measure_normals() {
    std::vector<RandomPair> u(kNormals);
    for (std::size_t k = 0; k < kNormals; ++k) u[k] = quasi_random_point(k);
    std::vector<Vec3<double>> wm(kNormals);
    std::vector<double> pdf(kNormals), d(kNormals);
    sampler_.sample(c_, u, wm);
    sampler_.pdf(c_, wm, pdf);
    sampler_.d(surface_, wm, d);
    for (std::size_t k = 0; k < kNormals; ++k) {
      if (wm[k].z < kSmallestHeight) continue;
      const Place place = place_of(c_, u[k].x, u[k].y);
      const auto pdf_of = [&](const auto& m) { return distribution_.pdf(m); };
      const auto facing = [&](const auto& m) { return distribution_.facing_pdf(m); };
      const auto d_of = [&](const auto& m) { return sampler_.exact->d(m, surface_); };
      errors_.pdf.see(density_distance(pdf[k], wm[k], surface_, pdf_of, facing), place);
      errors_.d.see(density_distance(d[k], wm[k], surface_, d_of, d_of), place);
    }
  }

  void measure_shadowing() {
    if (c_.height() == 0) return;  // Lambda is infinite
    const double lambda = sampler_.exact->lambda(c_.wi, surface_);
    const auto rounded = [&](double error) { return without_height_rounding(error, c_); };
    errors_.lambda.see(rounded(std::abs(sampler_.lambda(c_) - lambda) / (1 + lambda)),
                       place_of(c_));
    if (sampler_.claims.normals == SampledNormals::visible_v_cavity)
      return;  // its G1 is not Smith's
    errors_.g1.see(rounded(std::abs(sampler_.g1(c_) * (1 + lambda) - 1)), place_of(c_));
  }

  Vec2<double> slope(double u1, double u2) const {
    const RandomPair u{u1, u2};
    Vec3<double> wm{};
    sampler_.sample_double(c_, {&u, 1}, {&wm, 1});
    const StretchedSlope s = distribution_.frame().slope_of(wm);
    return {s.x / s.w, s.y / s.w};
  }

  /// |d(slope) / d(u1, u2)| by central differences.
  double determinant(const RandomPair& u) const {
    const double h1 = 1e-4 * std::min(u.x, 1 - u.x), h2 = 1e-4 * std::min(u.y, 1 - u.y);
    const auto [x1, y1] = slope(u.x - h1, u.y);
    const auto [x2, y2] = slope(u.x + h1, u.y);
    const auto [x3, y3] = slope(u.x, u.y - h2);
    const auto [x4, y4] = slope(u.x, u.y + h2);
    return std::abs(((x2 - x1) * (y4 - y3) - (y2 - y1) * (x4 - x3)) / (4 * h1 * h2));
  }

  /// The reciprocal of the map's density at `wm`, the normal at `u`: by differences of the map, or
  /// as the sampler states it.
  double area(const RandomPair& u, const Vec3<double>& wm) const {
    if (sampler_.sample_double) return distribution_.frame().jacobian(wm) * determinant(u);
    return 1 / sampler_.sampled_density(c_, u);
  }

  void measure_sampled_density() {
    if (!tells_density(sampler_)) return;
    for (std::size_t k = 0; k < kDerivatives; ++k) {
      const RandomPair u = quasi_random_point(k);
      const Vec3<double> wm = sampler_.sample_one(c_, u.x, u.y);
      double pdf = 0;
      sampler_.pdf(c_, {&wm, 1}, {&pdf, 1});
      errors_.jacobian.see(std::abs(pdf * area(u, wm) - 1), place_of(c_, u.x, u.y));
    }
  }

  const SamplerUnderTest& sampler_;
  Configuration c_;
  ExactSurface surface_;
  ExactDistribution distribution_;
  DensityErrors errors_;
};

}  // namespace

bool tells_density(const SamplerUnderTest& sampler) {
  return sampler.sample_double || sampler.sampled_density;
}

std::vector<CheckResult> check_density(const SamplerUnderTest& sampler,
                                       const support::Workers& workers) {
  return on_both_sides(sampler, check_configurations(sampler), [&](const Side& side) {
    const DensityErrors all = worst_over(side.list, workers, [&](const Configuration& c) {
      return DensityCheck(sampler, c).measure();
    });
    const Bounds& b = side.bounds;
    std::vector<CheckResult> results{
        all.integral.result(kCheck, "integral of pdf - 1", b.function_error),
        all.pdf.result(kCheck, "pdf of sampled normals", b.function_error),
        all.d.result(kCheck, "D", b.function_error),
        all.lambda.result(kCheck, "Lambda", b.function_error)};
    if (sampler.claims.normals != SampledNormals::visible_v_cavity)
      results.push_back(all.g1.result(kCheck, "G1", b.function_error));
    if (sampler.claims.monotone_inverse && tells_density(sampler))
      results.push_back(all.jacobian.result(kCheck, "pdf times |Jacobian| - 1", b.density_error));
    return results;
  });
}

}  // namespace vndf::validate

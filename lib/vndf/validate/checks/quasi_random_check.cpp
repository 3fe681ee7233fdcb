// Quasi-random check: the distribution of normals that are sampled at quasi-random points.
#include "vndf/validate/checks/quasi_random_check.h"

#include <algorithm>
#include <cmath>

#include "vndf/validate/checks/configurations.h"
#include "vndf/validate/checks/worst_over.h"
#include "vndf/validate/statistics/quasi_random.h"

namespace vndf::validate {
namespace {

struct Distances {
  Worst r, phi, x;

  void see(const Distances& o) { see_each(std::tie(r, phi, x), std::tie(o.r, o.phi, o.x)); }
};

Distances measure(const SamplerUnderTest& sampler, const Configuration& c, std::size_t points) {
  std::vector<RandomPair> u(points);
  for (std::size_t k = 0; k < points; ++k) u[k] = quasi_random_point(k);
  std::vector<Vec3<double>> wm(points);
  sampler.sample(c, u, wm);
  const ExactDistribution distribution(*sampler.exact, sampler.claims.normals, c);
  LineCounts r(kBins), phi(kBins), x(kBins);
  for (std::size_t k = 0; k < points; ++k) {
    const double place = (static_cast<double>(k) + 0.5) / static_cast<double>(points);
    const Uniforms w = distribution.uniforms(wm[k], place);
    r.add(w.r);
    phi.add(w.phi);
    x.add(w.x);
  }
  Distances d;
  d.r.see(r.distance(), place_of(c));
  d.phi.see(phi.distance(), place_of(c));
  d.x.see(x.distance(), place_of(c));
  return d;
}

}  // namespace

std::vector<CheckResult> check_quasi_random(const SamplerUnderTest& sampler, std::size_t points,
                                            const support::Workers& workers) {
  const double left = kQuasiRandomError * std::pow(static_cast<double>(points), -0.75);
  return on_both_sides(sampler, check_configurations(sampler), [&](const Side& side) {
    const Distances all = worst_over(
        side.list, workers, [&](const Configuration& c) { return measure(sampler, c, points); });
    const double bound = std::max(side.bounds.u_error, side.bounds.declared.u) + left;
    return std::vector{all.r.result("quasi-random", "radius, distance of cdfs", bound),
                       all.phi.result("quasi-random", "azimuth, distance of cdfs", bound),
                       all.x.result("quasi-random", "slope x, distance of cdfs", bound)};
  });
}

}  // namespace vndf::validate

// Scans p22 over all radii, then tries the two integrals that must exist.
#include "vndf/distributions/diagnose.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "vndf/distributions/slope_integrals.h"
#include "vndf/support/text.h"

namespace vndf::distributions {
namespace {

[[noreturn]] void fail(const SlopeDistribution& d, const std::string& why) {
  throw std::domain_error("distribution " + support::quoted(d.name()) + ": " + why);
}

constexpr double kFarthest = 1e8;

/// Returns the radii > 0 at which p22 is tried, increasing.
std::vector<double> radii_to_look_at(const SlopeDistribution& d) {
  constexpr int kCount = 4000;
  std::vector<double> radii;
  for (int i = 0; i <= kCount; ++i) radii.push_back(std::pow(kFarthest, 2.0 * i / kCount - 1));
  double last = 0;
  for (const double at : d.breaks()) {
    for (const double side : {1 - 1e-3, 1 - 1e-9, 1 + 1e-9, 1 + 1e-3}) radii.push_back(side * at);
    for (int i = 1; i < 8; ++i) radii.push_back(last + (at - last) * i / 8);
    last = at;
  }
  std::sort(radii.begin(), radii.end());
  radii.erase(std::unique(radii.begin(), radii.end()), radii.end());
  return radii;
}

void check_zero(const SlopeDistribution& d, const DiagnoseOptions& options) {
  const double density = d.p22(0);
  if (std::isnan(density) || density < 0)
    fail(d, "p22 is " + support::rounded_text(density) +
                " at slope radius 0; it must be >= 0 there (give the limit, for example by a "
                "condition: r > 0 ? ... : LIMIT)");
  if (std::isinf(density) && !options.singularity_at_zero_allowed)
    fail(d,
         "p22 is infinite at slope radius 0, where the quadratures would lose their precision; "
         "bound it there, for example with max(r, 1e-6) in place of r, or use the named "
         "distribution 'k', whose singularity is known");
}

double checked_density(const SlopeDistribution& d, double r) {
  const double density = d.p22(r);
  if (std::isinf(density) && density > 0)
    fail(d, "p22 is infinite at slope radius " + support::rounded_text(r) +
                "; only radius 0 may be singular");
  if (!(density >= 0))
    fail(d, "p22 is " + support::rounded_text(density) + " at slope radius " +
                support::rounded_text(r) + "; a density must be finite and >= 0");
  return density;
}

/// Returns the radius between `zero` and `positive` (in either order) at which p22 becomes
/// positive.
double edge(const SlopeDistribution& d, double zero, double positive) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (zero + positive);
    (checked_density(d, middle) > 0 ? positive : zero) = middle;
  }
  return positive;
}

/// Throws at the first interval on which p22 is 0 between positive values. One zero alone is no
/// interval, because p22 may touch 0 at a point.
void check_scan(const SlopeDistribution& d) {
  const std::vector<double> radii = radii_to_look_at(d);
  std::size_t last_positive = radii.size();
  for (std::size_t i = 0; i < radii.size(); ++i) {
    if (checked_density(d, radii[i]) == 0) continue;
    if (last_positive < i && i - last_positive > 2) {
      const double begin = edge(d, radii[last_positive + 1], radii[last_positive]);
      const double end = edge(d, radii[i - 1], radii[i]);
      fail(d, "p22 is zero from slope radius " + support::rounded_text(begin) + " to " +
                  support::rounded_text(end) +
                  " and positive on both sides; the map from random numbers to slopes would "
                  "not be unique there");
    }
    last_positive = i;
  }
  if (last_positive == radii.size())
    fail(d,
         "p22 is zero at every slope radius that was tried, from 1e-8 to 1e8; write it in "
         "other units of slope");
}

/// Throws where the mass lies beyond the scan, because the integrals would not find it and end in a
/// false reason. A mass that diverges slowly is left to them.
void check_place(const SlopeDistribution& d) {
  const auto mass = [&](double r) { return r * r * d.p22(r); };
  // Above r^-3/2 the mass up to r grows by more than the root of the factor of r.
  if (mass(kFarthest) > std::sqrt(10) * mass(kFarthest / 10))
    fail(d,
         "p22 does not fall up to a slope radius of 1e8, so that its mass would lie beyond; "
         "write it in other units of slope");
}

}  // namespace

void diagnose(const SlopeDistribution& d, const DiagnoseOptions& options) {
  check_zero(d, options);
  check_scan(d);
  check_place(d);
  mean_slope(d, slope_mass(d).value);  // both throw where they do not converge
}

}  // namespace vndf::distributions

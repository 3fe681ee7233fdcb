// Compares normalised slope densities at several roughnesses.
#include "vndf/distributions/shape_invariance.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>

#include "vndf/support/text.h"

namespace vndf::distributions {
namespace {

constexpr std::array kAlphas = {0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9};
constexpr std::size_t kRadii = 480;
constexpr double kLogRange = 3 * std::numbers::ln10;  // 1e-3 to 1e3

/// Differences count where a factor e of slope holds this mass, which is about the u-error of
/// tables.
constexpr double kRelevantMass = 1e-6;

/// Returns midpoints of equal steps of log r. r = 1, where compact distributions end, is none of
/// them.
double radius(std::size_t i) {
  const double step = 2 * kLogRange / kRadii;
  return std::exp(-kLogRange + (static_cast<double>(i) + 0.5) * step);
}

using Profile = std::array<double, kRadii>;

/// Returns 2 pi r^2 p22 at unit roughness, the mass per unit of log r, normalised over the range of
/// radii. What lies outside is the same fraction for all roughnesses of an invariant distribution.
Profile mass_profile(const Ndf& ndf, double alpha) {
  Profile profile{};
  double sum = 0;
  for (std::size_t i = 0; i < kRadii; ++i) {
    const double r = radius(i), slope = alpha * r, square = 1 + slope * slope;
    const double density = ndf(std::atan(slope), alpha);
    if (!(density >= 0) || !std::isfinite(density))
      throw std::domain_error("D is " + support::number_text(density) +
                              " at theta = " + support::number_text(std::atan(slope)) +
                              ", alpha = " + support::number_text(alpha) +
                              "; it must be finite and >= 0");
    profile[i] = r * r * density / square / square;
    sum += profile[i];
  }
  if (!(sum > 0))
    throw std::domain_error("D is zero at every theta for alpha = " + support::number_text(alpha));
  for (double& mass : profile) mass *= kRadii / (2 * kLogRange * sum);
  return profile;
}

}  // namespace

ShapeInvariance measure_shape_invariance(const Ndf& ndf) {
  std::array<Profile, kAlphas.size()> profiles{};
  for (std::size_t a = 0; a < kAlphas.size(); ++a) profiles[a] = mass_profile(ndf, kAlphas[a]);
  ShapeInvariance worst{0, kAlphas.front(), kAlphas.back(), 1};
  for (std::size_t i = 0; i < kRadii; ++i) {
    std::size_t low = 0, high = 0;
    for (std::size_t a = 1; a < kAlphas.size(); ++a) {
      if (profiles[a][i] < profiles[low][i]) low = a;
      if (profiles[a][i] > profiles[high][i]) high = a;
    }
    if (profiles[high][i] < kRelevantMass) continue;
    const double violation = 1 - profiles[low][i] / profiles[high][i];
    if (violation > worst.violation) worst = {violation, kAlphas[low], kAlphas[high], radius(i)};
  }
  return worst;
}

void require_shape_invariant(const Ndf& ndf, const std::string& name) {
  const ShapeInvariance found = measure_shape_invariance(ndf);
  if (found.violation <= kShapeInvariant) return;
  throw NotShapeInvariant(
      support::quoted(name) + " is not shape-invariant: at a slope of " +
      support::rounded_text(found.r) + " alpha, its normalised densities for alpha = " +
      support::number_text(found.alpha) + " and " + support::number_text(found.reference_alpha) +
      " differ by " + support::rounded_text(found.violation) +
      " of the larger, so that one table cannot serve every roughness; "
      "the surface of one alpha can be taken as the shape");
}

}  // namespace vndf::distributions

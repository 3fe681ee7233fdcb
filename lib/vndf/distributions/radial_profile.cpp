// The rules of a profile, and the coordinate in which it is smooth.
#include "vndf/distributions/radial_profile.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "vndf/support/text.h"

namespace vndf::distributions {
namespace {

[[noreturn]] void fail(const std::string& why) {
  throw std::invalid_argument("radial profile: " + why);
}

/// Returns "sample 3 (r = 0.5, p22 = 1)".
std::string sample_text(const RadialProfile& samples, std::size_t i) {
  return "sample " + std::to_string(i + 1) + " (r = " + support::number_text(samples.r[i]) +
         ", p22 = " + support::number_text(samples.p22[i]) + ")";
}

bool in_limits(double r) {
  return r == 0 || (r >= kSmallestRadius && r <= kLargestRadius);
}

void check_numbers(const RadialProfile& samples) {
  for (std::size_t i = 0; i < samples.r.size(); ++i) {
    const double r = samples.r[i], density = samples.p22[i];
    if (!(r >= 0 && density >= 0) || std::isinf(r) || std::isinf(density))
      fail(sample_text(samples, i) + ": radii and densities must be finite and >= 0");
    if (!in_limits(r) || density > kLargestPeak)
      fail(sample_text(samples, i) +
           ": radii must be 0 or lie within 1e-30 and 1e8, and densities must be at most 1e30; "
           "use other units, since the scale of either does not matter");
    if (i > 0 && !(r > samples.r[i - 1])) fail(sample_text(samples, i) + ": radii must increase");
    if (i > 0 && !(r - samples.r[i - 1] >= kSmallestRadiusStep * r))
      fail(sample_text(samples, i) +
           ": the radius differs from the one before by less than a part in 1e9; keep one of them");
  }
}

double half_density_radius(const RadialProfile& samples) {
  const double half = *std::max_element(samples.p22.begin(), samples.p22.end()) / 2;
  std::size_t i = samples.r.size() - 1;
  while (samples.p22[i] < half) --i;
  return samples.r[i] > 0 ? samples.r[i] : samples.r[i + 1];
}

}  // namespace

RadialProfile checked_profile(RadialProfile samples) {
  if (samples.r.size() != samples.p22.size()) fail("as many radii as densities are needed");
  if (samples.r.size() < kFewestProfileSamples) fail("at least 4 samples are needed");
  check_numbers(samples);
  const auto positive = [](double density) { return density > 0; };
  const auto begin = samples.p22.begin();
  const auto first = std::find_if(begin, samples.p22.end(), positive);
  if (first == samples.p22.end()) fail("p22 is zero at every sample");
  if (*std::max_element(first, samples.p22.end()) < kSmallestPeak)
    fail("p22 is below 1e-30 at every sample; use another unit, since its scale does not matter");
  const auto end = std::find_if(samples.p22.rbegin(), samples.p22.rend(), positive).base();
  if (const auto zero = std::find(first, end, 0); zero != end)
    fail(sample_text(samples, static_cast<std::size_t>(zero - begin)) +
         ": the density is zero between positive ones, where the map from random numbers to slopes "
         "would not be unique; leave such samples out, or end the profile before them");
  const auto from = first - begin - (first == begin ? 0 : 1);
  const auto to = end - begin + (end == samples.p22.end() ? 0 : 1);
  const auto cut = [&](std::vector<double>& list) {
    list = std::vector<double>(list.begin() + from, list.begin() + to);
  };
  cut(samples.r);
  cut(samples.p22);
  return samples;
}

ProfileCoordinate::ProfileCoordinate(const RadialProfile& samples) {
  const double scale = half_density_radius(samples);
  inverse_square_scale_ = 1 / (scale * scale);
}

double ProfileCoordinate::operator()(double r) const {
  return std::log1p(r * r * inverse_square_scale_);
}

}  // namespace vndf::distributions

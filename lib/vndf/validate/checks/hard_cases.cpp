// Hard cases: inputs at the edges of their ranges.
#include "vndf/validate/checks/hard_cases.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vndf/validate/checks/configurations.h"

namespace vndf::validate {
namespace {

constexpr const char* kCheck = "hard cases";
constexpr double kLargestDensity = 1e36;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Whether single precision carries D over the visible area, the density of a normal that faces wi.
bool is_carried(const SamplerUnderTest& sampler, const Configuration& c, const Vec3<double>& wm) {
  const double area = sampler.exact->visible_area(c.wi, c.surface());
  return area == 0 || sampler.exact->d(wm, c.surface()) < kLargestDensity * area;
}

/// The angles to the mean facet. From below 90 degrees on only what is claimed is measured.
constexpr double kAngles[] = {0.0,       1e-20,     1e-7, 0.1,       45.0,  89.0,  89.99,
                              90 - 1e-5, 90 - 1e-7, 90.0, 90 + 1e-5, 100.0, 135.0, 180.0};

struct HardErrors {
  Worst finite, unit, horizon, facing, pdf;
};

void measure(const SamplerUnderTest& sampler, const Configuration& c, const RandomPair& u,
             HardErrors& errors) {
  const Place place = place_of(c, u.x, u.y);
  const Vec3<double> wm = sampler.sample_one(c, u.x, u.y);
  const double length = std::sqrt(dot(wm, wm));
  errors.finite.see(std::isfinite(length) ? 0 : kInfinity, place);
  if (!std::isfinite(length)) return;
  errors.unit.see(std::abs(length - 1), place);
  errors.horizon.see(std::max(0.0, -wm.z), place);
  if (sampler.claims.normals != SampledNormals::all && sampler.claims_to_see(c))
    errors.facing.see(std::max(0.0, -dot(c.wi, wm)) / facing_stretch(*sampler.exact, c), place);
  // At the horizon of a heavy tail the density itself is beyond single precision, and infinite is
  // then no error.
  if (wm.z > 0 && !is_carried(sampler, c, wm)) return;
  double pdf = 0;
  sampler.pdf(c, {&wm, 1}, {&pdf, 1});
  errors.pdf.see(std::isfinite(pdf) && pdf >= 0 ? 0 : kInfinity, place);
}

}  // namespace

std::vector<CheckResult> check_hard_cases(const SamplerUnderTest& sampler) {
  constexpr double kSmallest = std::numeric_limits<float>::denorm_min();
  const double corners[] = {0, kSmallest, 0x1p-24, 0.5, 1 - 0x1p-24, 1};
  HardErrors errors;
  for (const auto& [ax, ay] : {std::pair{1e-4, 1e-4},
                               {1.0, 1.0},
                               {10.0, 10.0},
                               {1e-4, 0.1},
                               {0.1, 1e-4},
                               {10.0, 0.01},
                               {0.01, 10.0}})
    for (const double theta : kAngles) {
      if (theta > 90 && !sampler.claims.from_below) continue;
      for (const double phi : {0.0, 45.0, 90.0, 200.0}) {
        const Configuration c = on_surface(sampler, at_angles(theta, phi, ax, ay));
        for (const double u1 : corners)
          for (const double u2 : corners) measure(sampler, c, {u1, u2}, errors);
      }
    }
  std::vector<CheckResult> results{errors.finite.result(kCheck, "normals finite", 0),
                                   errors.unit.result(kCheck, "length - 1", kUnitSlack),
                                   errors.horizon.result(kCheck, "below the horizon", 0),
                                   errors.pdf.result(kCheck, "pdf finite, not negative", 0)};
  if (sampler.claims.normals != SampledNormals::all)
    results.push_back(errors.facing.result(kCheck, "facing away / (1 + alpha mu)", kFacingError));
  return results;
}

}  // namespace vndf::validate

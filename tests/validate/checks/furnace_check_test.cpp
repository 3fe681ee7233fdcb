// The furnace check notices surfaces that make light, and masking that is not reciprocal.
#include "vndf/validate/checks/furnace_check.h"

#include <string>

#include "support/catch.h"
#include "support/samplers_under_test.h"
#include "vndf/reference/ggx_caps.h"
#include "vndf/reference/ggx_ndf.h"
#include "vndf/reference/v_cavity.h"
#include "vndf/validate/validate.h"

using namespace vndf;
using namespace vndf::validate;
using namespace vndf::test;

namespace {

SamplerUnderTest caps() {
  return under_test("caps", exact_slopes("ggx"), GgxCaps<float>{}, GgxCaps<double>{}, Claims{});
}

const CheckResult& find(const std::vector<CheckResult>& results, const std::string& statistic) {
  for (const CheckResult& f : results)
    if (f.statistic == statistic) return f;
  FAIL("no statistic " << statistic);
  return results.front();
}

CheckResult measured(const SamplerUnderTest& sampler, const std::string& statistic) {
  return find(check_furnace(sampler, {}), statistic);
}

/// `bsdf` brighter by `factor`.
template <class Bsdf>
Bsdf brighter(const Bsdf& bsdf, double factor) {
  return [bsdf, factor](const Configuration& c, std::span<const Vec3<double>> wo,
                        std::span<double> f) {
    bsdf(c, wo, f);
    for (double& value : f) value *= factor;
  };
}

}  // namespace

TEST_CASE("a surface of Smith and one of V-cavities conserve area and energy") {
  const SamplerUnderTest cavities =
      under_test("cavities", exact_slopes("ggx"), VCavity<GgxNdf<float>>{},
                 VCavity<GgxNdf<double>>{}, {.normals = SampledNormals::visible_v_cavity});
  for (const SamplerUnderTest& sampler : {caps(), cavities})
    for (const CheckResult& f : check_furnace(sampler, {})) {
      CAPTURE(sampler.name, f.statistic, f.measured, f.bound, f.where.theta);
      CHECK(f.passed());
    }
}

TEST_CASE("a mirror and a glass that send out 0.1 % more than comes in are noticed, and how much") {
  SamplerUnderTest sampler = caps();
  sampler.mirror = brighter(sampler.mirror, 1.001);
  sampler.glass = brighter(sampler.glass, 1.001);
  // Smooth surfaces lose nothing to shadowing: the excess is all of it.
  for (const std::string statistic : {"energy of a mirror over 1", "energy of glass over 1"}) {
    const CheckResult f = measured(sampler, statistic);
    CHECK_FALSE(f.passed());
    CHECK(f.measured == Approx(1e-3).epsilon(0.1));
  }
}

TEST_CASE("an energy that is no number does not pass") {
  SamplerUnderTest sampler = caps();
  sampler.mirror = brighter(sampler.mirror, std::nan(""));
  CHECK_FALSE(measured(sampler, "energy of a mirror over 1").passed());
}

TEST_CASE("shadowing that forgets the outgoing direction is noticed as not reciprocal") {
  SamplerUnderTest sampler = caps();
  const auto right = sampler.g2;
  sampler.g2 = [right](const ExactSurface& surface, const Vec3<double>& wi, const Vec3<double>&,
                       const Vec3<double>& wm) { return right(surface, wi, wi, wm); };
  CHECK(measured(caps(), "reciprocity of G2").passed());
  CHECK(measured(sampler, "reciprocity of G2").measured > 0.1);
}

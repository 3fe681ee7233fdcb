// The furnace stage notices surfaces that make light, and masking that is not reciprocal.
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

Subject caps() {
  return make_subject("caps", law_of("ggx"), GgxCaps<float>{}, GgxCaps<double>{}, Claims{});
}

const Finding& find(const std::vector<Finding>& findings, const std::string& statistic) {
  for (const Finding& f : findings)
    if (f.statistic == statistic) return f;
  FAIL("no statistic " << statistic);
  return findings.front();
}

Finding measured(const Subject& subject, const std::string& statistic) {
  return find(test_furnace(subject, {}), statistic);
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
  const Subject cavities =
      make_subject("cavities", law_of("ggx"), VCavity<GgxNdf<float>>{}, VCavity<GgxNdf<double>>{},
                   {.law = NormalLaw::visible_v_cavity});
  for (const Subject& subject : {caps(), cavities})
    for (const Finding& f : test_furnace(subject, {})) {
      CAPTURE(subject.name, f.statistic, f.measured, f.bound, f.where.theta);
      CHECK(f.passed());
    }
}

TEST_CASE("a mirror and a glass that send out 0.1 % more than comes in are noticed, and how much") {
  Subject subject = caps();
  subject.mirror = brighter(subject.mirror, 1.001);
  subject.glass = brighter(subject.glass, 1.001);
  // Smooth surfaces lose nothing to shadowing: the excess is all of it.
  for (const std::string statistic : {"energy of a mirror over 1", "energy of glass over 1"}) {
    const Finding f = measured(subject, statistic);
    CHECK_FALSE(f.passed());
    CHECK(f.measured == Approx(1e-3).epsilon(0.1));
  }
}

TEST_CASE("an energy that is no number does not pass") {
  Subject subject = caps();
  subject.mirror = brighter(subject.mirror, std::nan(""));
  CHECK_FALSE(measured(subject, "energy of a mirror over 1").passed());
}

TEST_CASE("shadowing that forgets the outgoing direction is noticed as not reciprocal") {
  Subject subject = caps();
  const auto right = subject.g2;
  subject.g2 = [right](const Alpha<double>& alpha, const Vec3<double>& wi, const Vec3<double>&,
                       const Vec3<double>& wm) { return right(alpha, wi, wi, wm); };
  CHECK(measured(caps(), "reciprocity of G2").passed());
  CHECK(measured(subject, "reciprocity of G2").measured > 0.1);
}

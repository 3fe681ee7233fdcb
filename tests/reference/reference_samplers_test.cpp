// What every reference sampler promises for every input: finite unit normals on the right side,
// densities that are numbers, the stated results out of range.
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <utility>

#include "support/catch.h"
#include "support/directions.h"
#include "support/random_inputs.h"
#include "support/stated_results.h"
#include "support/visible_normals.h"
#include "vndf/bsdf/normal_sampler.h"
#include "vndf/reference/beckmann_analytic.h"
#include "vndf/reference/beckmann_exact.h"
#include "vndf/reference/beckmann_ndf.h"
#include "vndf/reference/blinn_phong_ndf.h"
#include "vndf/reference/generalised_trowbridge_reitz_ndf.h"
#include "vndf/reference/ggx_analytic.h"
#include "vndf/reference/ggx_caps.h"
#include "vndf/reference/ggx_exact.h"
#include "vndf/reference/ggx_hemisphere.h"
#include "vndf/reference/ggx_ndf.h"
#include "vndf/reference/v_cavity.h"
#include "vndf/reference/walter_roughness.h"

using namespace vndf;
using namespace vndf::test;

namespace {

/// Calls `use(name, sampler)` for each reference sampler, all of which a BSDF can take.
template <class T, class Use>
void for_each_sampler(Use use) {
  const auto visit = [&](const char* name, const auto& sampler) {
    static_assert(NormalSampler<std::decay_t<decltype(sampler)>, T>);
    use(name, sampler);
  };
  visit("beckmann analytic", BeckmannAnalytic<T>());
  visit("beckmann exact", BeckmannExact<T>());
  visit("ggx analytic", GgxAnalytic<T>());
  visit("ggx exact", GgxExact<T>());
  visit("ggx caps", GgxCaps<T>());
  visit("ggx hemisphere", GgxHemisphere<T>());
  visit("beckmann ndf", BeckmannNdf<T>());
  visit("ggx ndf", GgxNdf<T>());
  visit("blinn-phong ndf", BlinnPhongNdf<T>());
  visit("gtr 1 ndf", GeneralisedTrowbridgeReitzNdf<T>(GtrProfile(1)));
  visit("gtr 10 ndf", GeneralisedTrowbridgeReitzNdf<T>(GtrProfile(10)));
  visit("walter", WalterRoughness<BeckmannNdf<T>>());
  visit("v-cavity", VCavity<GgxNdf<T>>());
}

/// The analytic methods take a cone for normal incidence, where normals may face away from wi.
template <class Sampler>
constexpr double kConeOf = 2;
template <class T>
constexpr double kConeOf<BeckmannAnalytic<T>> = BeckmannAnalyticMethod::kNormalIncidence;
template <class T>
constexpr double kConeOf<GgxAnalytic<T>> = GgxAnalyticMethod::kNormalIncidence;

template <class Sampler, class T>
bool must_face(const Vec3<T>& wi, const Alpha<T>& alpha) {
  constexpr double kRounding = 1e-6;
  const double x = double{alpha.x} * double{wi.x}, y = double{alpha.y} * double{wi.y}, z = wi.z;
  return Sampler::kVisible && z / std::hypot(x, y, z) < kConeOf<Sampler> - kRounding;
}

/// What is wrong with the normal and the density for one input, or nothing.
template <class T, class Sampler>
std::string error_of(const Sampler& sampler, const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) {
  const Vec3<T> m = sampler.sample(wi, alpha, u1, u2);
  if (!finite_unit(m)) return "not a finite unit normal above the horizon";
  if (must_face<Sampler>(wi, alpha) && !(dot(wi, m) >= -kFacingSlack<T>))
    return "faces away from wi";
  if (!(sampler.pdf(wi, m, alpha) >= 0)) return "a density that is negative or no number";
  if (!(sampler.d(m, alpha) >= 0)) return "D that is negative or no number";
  return "";
}

template <class T>
void check_hard_inputs(int count, std::uint64_t seed) {
  for_each_sampler<T>([&](const char* name, const auto& sampler) {
    RandomInputs inputs(seed);
    for (int k = 0; k < count; ++k) {
      const SamplerInput in = inputs.hard();
      const auto f = [](double v) { return static_cast<T>(v); };
      const Vec3<T> wi{f(in.wi.x), f(in.wi.y), f(in.wi.z)};
      const Alpha<T> alpha{f(in.alpha.x), f(in.alpha.y)};
      const std::string wrong = error_of(sampler, wi, alpha, f(in.u1), f(in.u2));
      if (wrong.empty()) continue;
      const auto m = sampler.sample(wi, alpha, f(in.u1), f(in.u2));
      CAPTURE(name, sizeof(T), k, wi.x, wi.y, wi.z, alpha.x, alpha.y, in.u1, in.u2, m.x, m.y, m.z,
              dot(wi, m));
      FAIL(wrong);
    }
  });
}

template <class T>
void check_corners() {
  const T tiny = std::numeric_limits<T>::denorm_min(), step = std::numeric_limits<T>::epsilon();
  for_each_sampler<T>([&](const char* name, const auto& sampler) {
    for (const double degrees : {0.0, 1e-7, 45.0, 89.9999999, 90.0})
      for (const Alpha<T> alpha :
           {Alpha<T>{1, 1}, {T(1e-4), T(0.1)}, {10, T(1e-2)}, {T(1e-4), T(1e-4)}})
        for (const T u1 : {T(0), tiny, step, T(0.5), 1 - step / 2, T(1)})
          for (const T u2 : {T(0), tiny, step, T(0.5), 1 - step / 2, T(1)}) {
            Vec3<T> wi = direction_at<T>(degrees, 33);
            wi.z = std::max(wi.z, T(0));
            const std::string wrong = error_of(sampler, wi, alpha, u1, u2);
            CAPTURE(name, sizeof(T), degrees, alpha.x, alpha.y, u1, u2);
            if (!wrong.empty()) FAIL(wrong);
          }
  });
}

}  // namespace

TEST_CASE("the corners of u give every reference sampler a finite unit normal that faces wi") {
  check_corners<float>();
  check_corners<double>();
}

TEST_CASE("hard random inputs give every reference sampler a finite unit normal that faces wi") {
  check_hard_inputs<float>(20000, 5);
  check_hard_inputs<double>(20000, 6);
}

TEST_CASE("more hard random inputs do, too", "[.slow]") {
  const std::uint64_t seed = std::random_device{}();
  CAPTURE(seed);
  check_hard_inputs<float>(2000000, seed);
  check_hard_inputs<double>(2000000, seed);
}

TEST_CASE("an input out of its range gives every reference sampler the stated result") {
  for_each_sampler<float>([](const char* name, const auto& sampler) {
    CAPTURE(name);
    check_stated_results(sampler);
    CHECK(same(sampler.sample({0, 0.6f, -0.8f}, {1, 1}, 0.3f, 0.4f), {0, 0, 1}));
    CHECK(sampler.pdf({0, 0.6f, -0.8f}, {0, 0, 1}, {1, 1}) == 0);
  });
}

// The density of the interpolated map and its inverse: against differences of sample(), against
// closed forms, and as what they are for, unbiased estimates from tables that are far too small.
#include "vndf/visible_slope_map.h"

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "support/catch.h"
#include "support/closed_forms.h"
#include "support/directions.h"
#include "support/random_inputs.h"
#include "support/slope_midpoints.h"
#include "vndf/distributions/parse_distribution.h"
#include "vndf/precompute/build_tables.h"
#include "vndf/reference/ggx_caps.h"
#include "vndf/tabulated_sampler.h"

using namespace vndf;
using namespace vndf::test;

namespace {

precompute::BuiltTables built(const std::string& spec, const precompute::TableLayout& layout) {
  return precompute::build_tables(*distributions::parse_distribution(spec), {.layout = layout});
}

/// Built once.
const precompute::BuiltTables& medium(const std::string& spec) {
  static std::map<std::string, precompute::BuiltTables> cache;
  const auto found = cache.find(spec);
  if (found != cache.end()) return found->second;
  return cache.emplace(spec, built(spec, {.rows = 64, .columns = 64})).first->second;
}

/// Tables of 12 x 12, whose u-error is above 1e-3.
const precompute::BuiltTables& tiny_ggx() {
  static const auto tables = built("ggx", {.rows = 12, .columns = 12});
  return tables;
}

/// Fine tables in double precision.
const precompute::BuiltTables& precise_ggx() {
  static const auto tables = built("ggx", {.rows = 256, .columns = 96, .in_double = true});
  return tables;
}

template <class T>
Vec3<T> cast(const Vec3<double>& v) {
  return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
}

/// alpha log-uniform in [0.05, 1], theta below 89 degrees, u in the inner part of the unit square.
SamplerInput gentle(RandomInputs& random, double margin) {
  const double theta = 89 * std::numbers::pi / 180 * random.uniform();
  const double phi = 2 * std::numbers::pi * random.uniform();
  const auto alpha = [&] { return 0.05 * std::pow(20, random.uniform()); };
  const auto u = [&] { return margin + (1 - 2 * margin) * random.uniform(); };
  return {{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)},
          {alpha(), alpha()},
          u(),
          u()};
}

/// Solid angle per unit of u, from central differences of the slopes of sample(): dm = wm.z^3 times
/// their area. Slopes keep their digits in the tail, where normals are all but horizontal.
double area_by_differences(const TabulatedSampler<double>& sampler, const SamplerInput& in) {
  constexpr double kStep = 1e-6;
  const auto at = [&](double d1, double d2) {
    return slope_of(sampler.sample(in.wi, in.alpha, in.u1 + d1, in.u2 + d2));
  };
  const auto difference = [](const Vec2<double>& a, const Vec2<double>& b) {
    return Vec2<double>{(a.x - b.x) / (2 * kStep), (a.y - b.y) / (2 * kStep)};
  };
  const auto p = difference(at(kStep, 0), at(-kStep, 0));
  const auto q = difference(at(0, kStep), at(0, -kStep));
  const double z = sampler.sample(in.wi, in.alpha, in.u1, in.u2).z;
  return std::abs(p.x * q.y - p.y * q.x) * z * z * z;
}

/// Share of random inputs at which the density is not that of the differences: the second
/// derivative of the map jumps from cell to cell.
double share_off(const precompute::BuiltTables& tables, double bound) {
  const TabulatedSampler<double> sampler(tables.tables);
  RandomInputs random(17);
  constexpr int kCount = 3000;
  int off = 0;
  for (int k = 0; k < kCount; ++k) {
    const SamplerInput in = gentle(random, 1e-3);
    const double pdf = sampler.sample_with_density(in.wi, in.alpha, in.u1, in.u2).pdf;
    if (!(std::abs(pdf * area_by_differences(sampler, in) - 1) <= bound)) ++off;
  }
  return static_cast<double>(off) / kCount;
}

/// Mean and standard error of a stream of numbers.
class Mean {
 public:
  void add(double v) {
    ++count_;
    const double d = v - mean_;
    mean_ += d / count_;
    square_ += d * (v - mean_);
  }
  double mean() const { return mean_; }
  double error() const { return std::sqrt(square_ / (count_ - 1) / count_); }

 private:
  double count_ = 0, mean_ = 0, square_ = 0;
};

/// The visible mass of slopes x < `limit`, estimated with both weights, and what it is.
struct VisibleMass {
  Mean by_map, by_analytic;
  double exact;
};

/// Incidence and slope at which the marginal of `sampler` is off most, at roughness 1.
struct Place {
  Vec3<double> wi;
  double slope, cdf;
};

Place worst_place(const TabulatedSampler<double>& sampler) {
  Place place{};
  double worst = 0;
  for (double degrees = 1; degrees < 90; degrees += 1)
    for (double u = 0.02; u < 0.99; u += 0.01) {
      const double theta = degrees * std::numbers::pi / 180;
      const Vec3<double> wi{std::sin(theta), 0, std::cos(theta)};
      const double x = slope_of(sampler.sample(wi, {1, 1}, u, 0.5)).x;
      const double cdf = visible_cdf<GgxForms>(wi.z, wi.x, x);
      if (std::abs(cdf - u) <= worst) continue;
      worst = std::abs(cdf - u);
      place = {wi, x, cdf};
    }
  return place;
}

/// The visible mass of slopes below that of the worst place, from tables of 16 x 16.
VisibleMass visible_mass(long count, std::uint64_t seed) {
  const TabulatedSampler<double> sampler(tiny_ggx().tables);
  const GgxCaps<double> exact;
  const auto [wi, limit, cdf] = worst_place(sampler);

  VisibleMass result{{}, {}, cdf};
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
  for (long k = 0; k < count; ++k) {
    const double u1 = uniform(), u2 = uniform();
    const auto drawn = sampler.sample_with_density(wi, {1, 1}, u1, u2);
    const double inside = -drawn.wm.x < limit * drawn.wm.z ? 1 : 0;
    const double density = exact.pdf(wi, drawn.wm, {1, 1});
    result.by_map.add(drawn.pdf > 0 ? inside * density / drawn.pdf : 0);
    result.by_analytic.add(inside);  // f / pdf, and f is that pdf
  }
  return result;
}

void check_unbiased(const VisibleMass& mass) {
  constexpr double kStandardErrors = 4;  // exceeded once in 16000
  const double off = std::abs(mass.by_map.mean() - mass.exact);
  const double bias = std::abs(mass.by_analytic.mean() - mass.exact);
  WARN("weighted by the map: off by " << off << ", standard error " << mass.by_map.error()
                                      << "; by the analytic density: off by " << bias
                                      << ", standard error " << mass.by_analytic.error());
  CHECK(tiny_ggx().certificate.marginal.max_u_error > 1e-3);
  CHECK(off <= kStandardErrors * mass.by_map.error());
  CHECK(bias > kStandardErrors * mass.by_analytic.error());
}

/// Largest |invert(sample(u)) - u| over `count` inputs, with u in [margin, 1 - margin].
template <class T>
double inverse_error(const TabulatedSampler<T>& sampler, int count, double margin) {
  RandomInputs random(23);
  double worst = 0;
  for (int k = 0; k < count; ++k) {
    SamplerInput in = random.hard();
    in.u1 = margin + (1 - 2 * margin) * random.uniform();
    in.u2 = margin + (1 - 2 * margin) * random.uniform();
    const Vec3<T> wi = cast<T>(in.wi);
    const Alpha<T> alpha{static_cast<T>(in.alpha.x), static_cast<T>(in.alpha.y)};
    const T u1 = static_cast<T>(in.u1), u2 = static_cast<T>(in.u2);
    const auto u = sampler.invert(wi, sampler.sample(wi, alpha, u1, u2), alpha);
    if (!u) return std::numeric_limits<double>::infinity();
    worst =
        std::max({worst, std::abs(double{u->x} - double{u1}), std::abs(double{u->y} - double{u2})});
  }
  return worst;
}

const std::vector<std::string> kFamilies{"beckmann",
                                         "ggx",
                                         "student-t:gamma=1.55",
                                         "hyper-cauchy:q=1.75",
                                         "exponential-power:p=0.5",
                                         "exponential-power:p=16",
                                         "k:nu=1",
                                         "disk",
                                         "pearson-ii:m=1",
                                         "annulus:inner=0.5",
                                         "volcano",
                                         "blinn-phong:n=50",
                                         "mixture:0.7*ggx+0.3*beckmann@0.33",
                                         "mixture:0.5*ggx+0.5*beckmann@0.01"};

/// The tables of `from` with marginal columns first to last held at one value.
SlopeTables with_plateau(const SlopeTables& from, std::size_t first, std::size_t last) {
  SlopeTables tables = from;
  std::vector<float> values;
  const QuantileTable& t = from.marginal;
  for (std::size_t i = 0; i < t.rows(); ++i)
    for (std::size_t j = 0; j < t.columns(); ++j)
      values.push_back(static_cast<float>(t.row(i)[j > first && j <= last ? first : j].value));
  tables.marginal = QuantileTable(t.rows(), t.columns(), values);
  return tables;
}

}  // namespace

TEST_CASE("sample_with_density gives the normal of sample, bit for bit") {
  RandomInputs random(3);
  const TabulatedSampler<float> single(tiny_ggx().tables);
  const TabulatedSampler<double> both(medium("ggx").tables);
  for (int k = 0; k < 20000; ++k) {
    const SamplerInput in = random.hard_anywhere();
    const Alpha<float> alpha{static_cast<float>(in.alpha.x), static_cast<float>(in.alpha.y)};
    const auto u1 = static_cast<float>(in.u1), u2 = static_cast<float>(in.u2);
    const auto wi = cast<float>(in.wi);
    REQUIRE(
        same(single.sample_with_density(wi, alpha, u1, u2).wm, single.sample(wi, alpha, u1, u2)));
    REQUIRE(same(both.sample_with_density(in.wi, in.alpha, in.u1, in.u2).wm,
                 both.sample(in.wi, in.alpha, in.u1, in.u2)));
  }
}

TEST_CASE("the density is the reciprocal of the Jacobian that differences of sample give") {
  // Differences over 2e-6 err by their square times the third derivative, and by a whole jump of
  // the second derivative in the few that straddle a node.
  constexpr double kBound = 1e-4, kShare = 0.003;
  CHECK(share_off(tiny_ggx(), kBound) <= kShare);
  CHECK(share_off(medium("ggx"), kBound) <= kShare);
  CHECK(share_off(precise_ggx(), kBound) <= kShare);
  CHECK(share_off(medium("student-t:gamma=1.55"), kBound) <= kShare);
  CHECK(share_off(medium("disk"), kBound) <= kShare);
}

/// The density of the map at a given normal: that of the random numbers which give it.
double density_at(const TabulatedSampler<double>& sampler, const Vec3<double>& wi,
                  const Vec3<double>& wm, const Alpha<double>& alpha) {
  const auto u = sampler.invert(wi, wm, alpha);
  return u ? sampler.sample_with_density(wi, alpha, u->x, u->y).pdf : 0;
}

TEST_CASE("the density at a given normal is that of sampling it, and integrates to 1") {
  const TabulatedSampler<double> sampler(tiny_ggx().tables);
  RandomInputs random(29);
  for (int k = 0; k < 2000; ++k) {
    const SamplerInput in = gentle(random, 1e-3);
    const auto drawn = sampler.sample_with_density(in.wi, in.alpha, in.u1, in.u2);
    REQUIRE(density_at(sampler, in.wi, drawn.wm, in.alpha) == Approx(drawn.pdf).epsilon(1e-9));
  }
  constexpr double kMidpointError = 3e-3;  // the density jumps at nodes and where facets turn away
  for (const double degrees : {0.0, 50.0, 80.0}) {
    const double theta = degrees * std::numbers::pi / 180;
    const Vec3<double> wi{std::sin(theta), 0, std::cos(theta)};
    const Alpha<double> alpha{0.5, 0.3};
    const auto density = [&](const Vec3<double>& m) { return density_at(sampler, wi, m, alpha); };
    CAPTURE(degrees);
    CHECK(over_slopes(density, alpha) == Approx(1).margin(kMidpointError));
  }
}

TEST_CASE("the density of the map of a good table is the analytic density") {
  const TabulatedSampler<double> sampler(precise_ggx().tables);
  const GgxCaps<double> exact;
  RandomInputs random(31);
  // Measured: 0.5 %. The derivative of a cubic errs by far more than its value, off by 6e-6 in u.
  constexpr double kDensityError = 0.01;
  double worst = 0;
  for (int k = 0; k < 5000; ++k) {
    const SamplerInput in = gentle(random, 0.01);
    const auto drawn = sampler.sample_with_density(in.wi, in.alpha, in.u1, in.u2);
    worst = std::max(worst, std::abs(drawn.pdf / exact.pdf(in.wi, drawn.wm, in.alpha) - 1));
  }
  CHECK(worst <= kDensityError);
}

TEST_CASE(
    "weighted by its own density a 16 x 16 table is unbiased; by the analytic one it is not") {
  check_unbiased(visible_mass(4000000, 41));
}

TEST_CASE("the same at 1e9 samples", "[.slow]") {
  check_unbiased(visible_mass(1000000000, std::random_device{}()));
}

TEST_CASE("invert undoes sample") {
  for (const auto* built_tables : {&tiny_ggx(), &medium("ggx"), &precise_ggx(), &medium("disk"),
                                   &medium("student-t:gamma=1.55")}) {
    const auto& tables = built_tables->tables;
    CAPTURE(tables->distribution, tables->marginal.rows());
    CHECK(inverse_error(TabulatedSampler<double>(tables), 20000, kInverseMargin) <=
          kInverseError<double>);
    CHECK(inverse_error(TabulatedSampler<float>(tables), 20000, kInverseMargin) <=
          kInverseError<float>);
  }
}

TEST_CASE("invert undoes sample for every family", "[.slow]") {
  for (const std::string& family : kFamilies) {
    const auto& tables = medium(family).tables;
    CAPTURE(family);
    CHECK(inverse_error(TabulatedSampler<double>(tables), 200000, kInverseMargin) <=
          kInverseError<double>);
    CHECK(inverse_error(TabulatedSampler<float>(tables), 200000, kInverseMargin) <=
          kInverseError<float>);
  }
}

TEST_CASE("near the ends of u invert loses nothing in double, and in float what is stated") {
  // The largest is at the rim of the disk (visible_slope_map.h).
  constexpr double kInDouble = 1e-12, kInFloat = 2e-4;
  const auto& disk = medium("disk").tables;
  CHECK(inverse_error(TabulatedSampler<double>(disk), 50000, 1e-7) <= kInDouble);
  CHECK(inverse_error(TabulatedSampler<float>(disk), 50000, 1e-7) <= kInFloat);
}

TEST_CASE("a normal that the map does not reach has no random numbers") {
  const TabulatedSampler<double> ggx(tiny_ggx().tables);
  const Vec3<double> wi{0.8, 0, 0.6};
  const auto absent = [](const auto& sampler, const Vec3<double>& w, const Vec3<double>& m,
                         const Alpha<double>& alpha) { return !sampler.invert(w, m, alpha); };
  CHECK(absent(ggx, wi, {-0.8, 0, 0.6}, {1, 1}));  // faces away
  CHECK(absent(ggx, wi, {-0.601, 0, std::sqrt(1 - 0.601 * 0.601)}, {1, 1}));
  CHECK(absent(ggx, wi, {0, 0.6, -0.8}, {1, 1}));  // below the horizon
  CHECK(absent(ggx, {0.6, 0, -0.8}, {0, 0, 1}, {1, 1}));
  CHECK(absent(ggx, wi, {0, 0, 1}, {0, 1}));
  CHECK_FALSE(absent(ggx, wi, {0, 0, 1}, {1, 1}));

  // The slopes of the disk end at 1.
  const TabulatedSampler<double> disk(medium("disk").tables);
  const auto with_slope = [](double x, double y) {
    return normalize_or_up(Vec3<double>{-x, -y, 1});
  };
  CHECK_FALSE(absent(disk, wi, with_slope(0.1, 0.99), {1, 1}));
  CHECK(absent(disk, wi, with_slope(0.1, 1.01), {1, 1}));
  CHECK(absent(disk, {0, 0, 1}, with_slope(1.01, 0), {1, 1}));
}

TEST_CASE("the corners of u have a finite density, 0 on the boundary") {
  const TabulatedSampler<float> sampler(tiny_ggx().tables);
  constexpr float kJustBelowOne = 1 - 0x1p-24f;
  const std::vector<float> corners{0, 0x1p-149f, 0x1p-24f, 0.5f, kJustBelowOne, 1};
  for (const double degrees : {0.0, 1e-7, 45.0, 89.9999999, 90.0})
    for (const Alpha<float> alpha : {Alpha<float>{1, 1}, {1e-4f, 0.1f}, {10, 1e-2f}})
      for (const float u1 : corners)
        for (const float u2 : corners) {
          const double theta = degrees * std::numbers::pi / 180;
          const Vec3<float> wi{static_cast<float>(std::sin(theta)), 0,
                               std::max(0.0f, static_cast<float>(std::cos(theta)))};
          const float pdf = sampler.sample_with_density(wi, alpha, u1, u2).pdf;
          CAPTURE(degrees, alpha.x, alpha.y, u1, u2, pdf);
          REQUIRE(std::isfinite(pdf));
          REQUIRE(pdf >= 0);
          if (u1 == 0 || u1 == 1 || u2 == 0 || u2 == 1) REQUIRE(pdf == 0);
        }
}

TEST_CASE("the density is continuous at u2 = 1/2, where both derivatives vanish") {
  const TabulatedSampler<double> sampler(precise_ggx().tables);
  const auto density = [&](double u2) {
    return sampler.sample_with_density({0.6, 0, 0.8}, {1, 1}, 0.4, u2).pdf;
  };
  CHECK(density(0.5) == Approx(density(0.5 + 1e-11)).epsilon(1e-3));
  CHECK(density(0.5) == Approx(density(0.5 - 1e-11)).epsilon(1e-3));
}

TEST_CASE("where the map is flat the density is the largest number, and the rest stays unbiased") {
  const TabulatedSampler<double> sampler(share(with_plateau(*medium("ggx").tables, 40, 44)));
  const GgxCaps<double> exact;
  const Vec3<double> wi{0.6, 0, 0.8};
  const double u = marginal_column_inverse(42.0 / 63).u;
  CHECK(sampler.sample_with_density(wi, {1, 1}, u, 0.3).pdf == std::numeric_limits<double>::max());
  const auto inside = sampler.invert(wi, sampler.sample(wi, {1, 1}, u, 0.3), {1, 1});
  REQUIRE(inside);
  const auto there = sampler.sample(wi, {1, 1}, inside->x, inside->y);
  const auto given = sampler.sample(wi, {1, 1}, u, 0.3);
  CHECK(std::hypot(there.x - given.x, there.y - given.y, there.z - given.z) <=
        kInverseError<double>);

  // The map still covers all normals, so the visible mass of all of them is 1: by the midpoint
  // rule.
  constexpr int kSide = 1000;
  double mass = 0;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const auto drawn =
          sampler.sample_with_density(wi, {1, 1}, (i + 0.5) / kSide, (j + 0.5) / kSide);
      mass += exact.pdf(wi, drawn.wm, {1, 1}) / drawn.pdf;
    }
  CHECK(mass / kSide / kSide == Approx(1).margin(2e-3));
}

TEST_CASE("an input outside its range gives the upright normal with density 0") {
  const TabulatedSampler<double> sampler(tiny_ggx().tables);
  const auto drawn = sampler.sample_with_density({0.6, 0, 0.8}, {0, 1}, 0.3, 0.4);
  CHECK(same(drawn.wm, {0, 0, 1}));
  CHECK(drawn.pdf == 0);
}

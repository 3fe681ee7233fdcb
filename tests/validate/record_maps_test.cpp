// Maps behind records are recognised whatever the size of their error and the order of their random
// numbers, at each configuration by itself, and judged there; what is no inverse is told.
#include "vndf/validate/record_maps.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "support/built_tables.h"
#include "support/catch.h"
#include "support/drawn_records.h"
#include "support/samplers_under_test.h"
#include "vndf/reference/beckmann_exact.h"
#include "vndf/reference/ggx_caps.h"
#include "vndf/reference/ggx_exact.h"
#include "vndf/reference/ggx_hemisphere.h"
#include "vndf/validate/checks/cross_check.h"
#include "vndf/validate/validate_records.h"

using namespace vndf;
using namespace vndf::validate;
using namespace vndf::test;

namespace {

const std::string kMap = "inverse";
const std::string kSlopeX = "u-error of slope x", kSlopeY = "u-error of slope y";

/// The incidences at which published samplers change their method, and others.
const std::vector<Configuration> kSome{at_angles(0.2, 20, 0.3, 0.1), at_angles(35, 100, 0.5, 0.5),
                                       at_angles(60, 200, 0.2, 0.9), at_angles(88, 310, 1, 0.05)};

/// A sampler of GGX in single precision that may be another at each configuration, and whose random
/// numbers may be moved before they are used.
template <class Sample>
struct MadeOf {
  using Scalar = float;
  Sample sample_at;

  Vec3<float> sample(const Vec3<float>& wi, const Alpha<float>& alpha, float u1, float u2) const {
    return sample_at(wi, alpha, u1, u2);
  }
  float pdf(const Vec3<float>& wi, const Vec3<float>& wm, const Alpha<float>& alpha) const {
    return GgxExact<float>{}.pdf(wi, wm, alpha);
  }
};
template <class Sample>
MadeOf(Sample) -> MadeOf<Sample>;

/// The cosine of the stretched incident direction.
float stretched_cosine(const Vec3<float>& wi, const Alpha<float>& alpha) {
  return wi.z / std::hypot(alpha.x * wi.x, alpha.y * wi.y, wi.z);
}

/// Polar within the cone of the published sampler, and outside the inverse with slope y off by up
/// to `error` in u.
auto polar_near_pole(float error) {
  return MadeOf{[error](const Vec3<float>& wi, const Alpha<float>& alpha, float u1, float u2) {
    if (stretched_cosine(wi, alpha) > 0.9999f) return GgxCaps<float>{}.sample(wi, alpha, u1, u2);
    return GgxExact<float>{}.sample(wi, alpha, u1, u2 + error * 4 * u2 * (1 - u2));
  }};
}

/// GGX by the hemisphere (Heitz 2018) with the concentric map of the square to the disk (Shirley
/// and Chiu 1997), as a renderer has it: an exact distribution by a map that is nearly ordered as
/// the inverse is.
Vec3<float> concentric(const Vec3<float>& wi, const Alpha<float>& alpha, float u1, float u2) {
  const double a = 2.0 * u1 - 1, b = 2.0 * u2 - 1, quarter = std::numbers::pi / 4;
  const bool first = std::abs(a) > std::abs(b);
  const double radius = first ? a : b;
  const double phi = radius == 0 ? 0 : first ? quarter * b / a : 2 * quarter - quarter * a / b;
  const double turn = std::atan2(radius * std::sin(phi), radius * std::cos(phi));
  const double u_phi = turn / (2 * std::numbers::pi);
  return vector_of<float>(GgxHemisphere<double>{}.sample(
      vector_of<double>(wi), {alpha.x, alpha.y}, radius * radius, u_phi < 0 ? u_phi + 1 : u_phi));
}

Verdict judged(const Records& records, const RecordOptions& options = {}) {
  return validate_records(records, *exact_slopes("ggx"), options);
}

/// What is not run of the map, as one text.
std::string skipped_map(const Verdict& verdict) {
  std::string text;
  for (const SkippedCheck& s : verdict.skipped)
    if (s.check == kMap) text += s.reason + "\n";
  return text;
}

bool judges_map(const Verdict& verdict) {
  return std::any_of(verdict.results.begin(), verdict.results.end(),
                     [](const CheckResult& f) { return f.check == kMap; });
}

}  // namespace

TEST_CASE("roughness that is too large is rejected at 1e4 records, however large the error is") {
  const Configuration c = at_angles(60, 40, 0.5, 0.2);
  for (const double percent : {0.01, 0.1, 1.0, 2.0, 3.0, 4.0, 5.0, 10.0, 30.0, 100.0}) {
    Configuration rougher = c;
    rougher.alpha = {c.alpha.x * (1 + percent / 100), c.alpha.y * (1 + percent / 100)};
    Records records = draw_records(GgxExact<float>{}, std::span{&rougher, 1}, 10000, 5);
    records.has_pdf = false;
    for (Record& r : records.list) r.configuration = c;
    const Verdict v = judged(records);
    CAPTURE(percent);
    CHECK_FALSE(v.passed());
    if (percent > 30) continue;  // twice the roughness changes the order too, and counts show it
    CHECK_FALSE(result_of(v, kMap, kSlopeX).passed());
    CHECK_FALSE(result_of(v, kMap, kSlopeY).passed());
  }
}

TEST_CASE("a map is recognised in all eight forms, accepted if exact and rejected if 2e-5 off") {
  const Records exact = draw_records(GgxExact<float>{}, kSome, 400, 8);
  Records off_x = exact, off_y = exact;
  for (Record& r : off_x.list) r.u1 = r.u1 < 0.5 ? r.u1 + 2e-5 : r.u1 - 2e-5;
  for (Record& r : off_y.list) r.u2 = r.u2 < 0.5 ? r.u2 + 2e-5 : r.u2 - 2e-5;
  for (int form = 0; form < 8; ++form) {
    const bool swapped = form & 1, mirrored_1 = form & 2, mirrored_2 = form & 4;
    CAPTURE(swapped, mirrored_1, mirrored_2);
    const Verdict good = judged(in_form(exact, swapped, mirrored_1, mirrored_2));
    CHECK(good.passed());
    CHECK(skipped_map(good).empty());
    CHECK(result_of(good, kMap, kSlopeX).measured < 5e-6);
    CHECK(result_of(good, kMap, kSlopeY).measured < 5e-6);
    const Verdict bad_x = judged(in_form(off_x, swapped, mirrored_1, mirrored_2));
    CHECK(result_of(bad_x, kMap, kSlopeX).measured == Approx(2e-5).epsilon(0.1));
    CHECK(result_of(bad_x, kMap, kSlopeY).passed());
    const Verdict bad_y = judged(in_form(off_y, swapped, mirrored_1, mirrored_2));
    CHECK(result_of(bad_y, kMap, kSlopeX).passed());
    CHECK(result_of(bad_y, kMap, kSlopeY).measured == Approx(2e-5).epsilon(0.1));
  }
}

TEST_CASE("the form of the map at the worst place is told") {
  Records records = draw_records(GgxExact<float>{}, kSome, 200, 2);
  records = in_form(records, true, false, true);
  const Verdict v = judged(records);
  CHECK_THAT(result_of(v, kMap, kSlopeX).note, contains("x decreases with u2"));
  CHECK_THAT(result_of(v, kMap, kSlopeY).note, contains("y increases with u1"));
}

TEST_CASE("a map that is polar at one configuration is judged at the others") {
  const Verdict good = judged(draw_records(polar_near_pole(0), kSome, 1000, 3));
  CHECK(good.passed());
  CHECK_THAT(skipped_map(good),
             contains("in 1 of 4 configurations the map is no inverse of the CDFs") &&
                 contains("theta 0.2, alpha 0.3 x 0.1"));
  REQUIRE(good.skipped.size() > 0);
  const Verdict bad = judged(draw_records(polar_near_pole(1e-4f), kSome, 1000, 3));
  CHECK(result_of(bad, kMap, kSlopeX).passed());
  CHECK(result_of(bad, kMap, kSlopeY).measured == Approx(1e-4).epsilon(0.1));
  CHECK(bad.failures().front().statistic == kSlopeY);
}

TEST_CASE(
    "where each record has its own configuration, bands of incidence are judged, but not the "
    "one in which the map changes") {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
    const auto list = random_configurations(5000, seed);
    const Verdict good = judged(draw_records(polar_near_pole(0), list, 1, seed));
    CAPTURE(seed, skipped_map(good));
    CHECK(good.passed());
    CHECK(judges_map(good));
    CHECK_THAT(skipped_map(good), contains("bands of incidence"));
    const Verdict bad = judged(draw_records(polar_near_pole(1e-4f), list, 1, seed));
    CHECK(result_of(bad, kMap, kSlopeY).measured == Approx(1e-4).epsilon(0.1));
  }
}

TEST_CASE("exact samplers with other maps are accepted, and it is told that their map is none") {
  const auto accepted = [](const auto& sampler) {
    const Verdict v = judged(draw_records(sampler, kSome, 500, 4));
    CHECK(v.passed());
    CHECK_FALSE(judges_map(v));
    CHECK_THAT(skipped_map(v), contains("in 4 of 4 configurations the map is no inverse"));
  };
  accepted(GgxCaps<float>{});
  accepted(GgxHemisphere<float>{});
  accepted(MadeOf{concentric});
}

TEST_CASE("concentric maps are never taken for the inverse, with 100 records at any incidence") {
  std::vector<Configuration> list;
  for (int k = 0; k <= 90; ++k) list.push_back(at_angles(k, 4 * k, 0.3, 0.8));
  const Verdict v = judged(draw_records(MadeOf{concentric}, list, 100, 7));
  CHECK_FALSE(judges_map(v));
  CHECK_THAT(skipped_map(v), contains("in 91 of 91 configurations the map is no inverse"));
}

TEST_CASE("a band of which few records are of another map is not judged, and it is told") {
  // 32 bands of 1000, and the first 1002 records by stretched incidence are polar: two in the
  // second band leave its rank correlation at 0.999.
  const auto list = random_configurations(32000, 12);
  std::vector<float> cosines;
  for (const Configuration& c : list)
    cosines.push_back(stretched_cosine(vector_of<float>(c.wi), alpha_of<float>(c.alpha)));
  std::sort(cosines.begin(), cosines.end(), std::greater<>());
  const auto mixed = MadeOf{
      [edge = cosines[1002]](const Vec3<float>& wi, const Alpha<float>& alpha, float u1, float u2) {
        return stretched_cosine(wi, alpha) > edge ? GgxCaps<float>{}.sample(wi, alpha, u1, u2)
                                                  : GgxExact<float>{}.sample(wi, alpha, u1, u2);
      }};
  const Verdict v = judged(draw_records(mixed, list, 1, 13));
  CHECK(v.passed());
  CHECK_THAT(result_of(v, kMap, kSlopeX).note, contains("30000 records"));
  CHECK_THAT(skipped_map(v), contains("in 1 of 32 bands of incidence the map is no inverse") &&
                                 contains("that of a band next to it is none"));
}

TEST_CASE("one record of many that is 5e-5 off is found, wherever it is") {
  for (const std::size_t place : {3u, 1001u, 1999u}) {
    Records records = draw_records(GgxExact<float>{}, kSome, 500, 6);
    double& u1 = records.list[place].u1;
    u1 += u1 < 0.5 ? 5e-5 : -5e-5;
    const CheckResult f = result_of(judged(records), kMap, kSlopeX);
    CHECK(f.measured == Approx(5e-5).epsilon(0.1));
    CHECK(f.where.u1 == u1);
  }
}

/// Records of the exact map in double precision, with the normal rounded to single precision, at
/// random numbers far into the tails.
Records rounded_records(const ExactSlopes& slopes, const std::vector<Configuration>& list) {
  Records records{{}, true, false};
  std::mt19937_64 random(3);
  const auto number = [&](std::size_t k) {
    const double u = static_cast<double>(random() >> 40) * 0x1p-24;
    return k % 3 == 0 ? u : k % 3 == 1 ? u * 1e-5 : 1 - u * 1e-5;
  };
  for (std::size_t k = 0; k < 1800; ++k) {
    const Configuration& c = list[k % list.size()];
    const double u1 = number(k / 6), u2 = number(k / 18);
    const auto wm = vector_of<float>(exact_normal(slopes, c, u1, u2));
    records.list.push_back({c, vector_of<double>(wm), u1, u2});
  }
  return records;
}

TEST_CASE("the rounding of a normal is no error of the map: heavy tails and rims, rotated") {
  const std::vector<Configuration> list{at_angles(50, 33, 1, 0.01), at_angles(20, 61, 0.3, 0.3)};
  for (const std::string name : {"student-t:gamma=1.6", "disk"}) {
    const auto slopes = exact_slopes(name);
    const Verdict v =
        validate_records(rounded_records(*slopes, list), *slopes, {.monotone_inverse = true});
    CAPTURE(name);
    CHECK(result_of(v, kMap, kSlopeX).measured < 1e-6);
    CHECK(result_of(v, kMap, kSlopeY).measured < 1e-6);
  }
}

TEST_CASE("what is said of the map decides over what is recognised") {
  const Records polar = draw_records(GgxCaps<float>{}, kSome, 300, 9);
  CHECK_FALSE(judged(polar, {.monotone_inverse = true}).passed());
  const Records exact = draw_records(GgxExact<float>{}, kSome, 300, 9);
  CHECK(judges_map(judged(exact, {.monotone_inverse = true})));
  const Verdict unsaid = judged(exact, {.monotone_inverse = false});
  CHECK_FALSE(judges_map(unsaid));
  CHECK_THAT(skipped_map(unsaid), contains("said to be no inverse"));
}

TEST_CASE("records of configurations that have too few for a map are told") {
  Records records = draw_records(GgxExact<float>{}, std::span{kSome}.first(1), 200, 9);
  const Records few = draw_records(GgxExact<float>{}, std::span{kSome}.last(1), 99, 9);
  records.list.insert(records.list.end(), few.list.begin(), few.list.end());
  const Verdict v = judged(records);
  CHECK(judges_map(v));
  CHECK_THAT(skipped_map(v), contains("99 records are in configurations of fewer than 100"));
  records.list.push_back(records.list.back());
  CHECK(skipped_map(judged(records)).empty());
}

TEST_CASE("400 files of 1e4 records of exact samplers raise no alarm, in any form", "[.slow]") {
  // A right file is rejected with a probability of 1e-6, so no alarm is expected in 400. The tables
  // are judged with the bounds of their certificate, as their users would.
  const auto ggx = exact_slopes("ggx"), beckmann = exact_slopes("beckmann"),
             student = exact_slopes("student-t:gamma=2.5");
  const auto& built = large_tables("student-t:gamma=2.5");
  const TabulatedSampler<float> tables(built.tables);
  const Bounds bounds = bounds_of(built.certificate, 1024);
  std::random_device fresh;
  int alarms = 0;
  const auto look = [&](const Records& exact, const ExactSlopes& slopes, std::uint64_t seed,
                        const RecordOptions& options) {
    const std::uint64_t form = seed >> 8;
    Records records = in_form(exact, form & 1, form & 2, form & 4);
    records.has_pdf = seed & 1;
    const Verdict v = validate_records(records, slopes, options);
    CAPTURE(seed, form & 7);
    for (const CheckResult& f : v.results) {
      CAPTURE(f.check, f.statistic, f.measured, f.bound, f.where.theta, f.where.alpha_x, f.note);
      CHECK(f.passed());
    }
    alarms += v.passed() ? 0 : 1;
  };
  for (int k = 0; k < 100; ++k) {
    const std::uint64_t seed = (std::uint64_t{fresh()} << 32) | fresh();
    // One configuration, twenty, or one for each record.
    const std::size_t count = k % 3 == 0 ? 1 : k % 3 == 1 ? 20 : 10000;
    const auto list = random_configurations(count, seed);
    const auto each = 10000 / count;
    look(draw_records(GgxExact<float>{}, list, each, seed), *ggx, seed, {});
    look(draw_records(GgxCaps<float>{}, list, each, seed), *ggx, seed, {});
    look(draw_records(BeckmannExact<float>{}, list, each, seed), *beckmann, seed, {});
    look(draw_records(tables, list, each, seed), *student, seed,
         {.u_error = bounds.u_error, .declared = bounds.declared});
  }
  CHECK(alarms == 0);
}

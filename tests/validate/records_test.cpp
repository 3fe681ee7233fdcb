// Records of somebody's sampler are read strictly, accepted where they are right, and rejected at
// the place where they are wrong.
#include "vndf/validate/records.h"

#include <cmath>
#include <random>
#include <sstream>

#include "support/built_tables.h"
#include "support/catch.h"
#include "support/drawn_records.h"
#include "support/samplers_under_test.h"
#include "vndf/validate/validate_records.h"

using namespace vndf;
using namespace vndf::validate;
using namespace vndf::test;

namespace {

Records read(const std::string& text) {
  std::istringstream stream(text);
  return read_records(stream, "records.csv");
}

const std::string kHeader = "wx,wy,wz,ax,ay,u1,u2,mx,my,mz\n";
const std::string kSurfaceHeader = "wx,wy,wz,ax,ay,correlation,mean_x,mean_y,mx,my,mz\n";

void check_refused(const std::string& text, const std::string& message) {
  CHECK_THROWS_WITH(read(text), contains("records.csv") && contains(message));
}

/// Random directions and roughness, or one configuration.
struct Draw {
  std::size_t count = 50000;
  bool one_configuration = false;
};

template <class Sampler>
Records draw(const Sampler& sampler, const Draw& options) {
  std::mt19937_64 random(21);
  std::uniform_real_distribution<float> uniform;
  Records records{{}, true, true};
  for (std::size_t k = 0; k < options.count; ++k) {
    const Configuration c = options.one_configuration
                                ? at_angles(70, 20, 0.5, 0.2)
                                : at_angles(90 * uniform(random), 360 * uniform(random),
                                            0.1 + uniform(random), 0.1 + uniform(random));
    const float u1 = uniform(random), u2 = uniform(random);
    const auto wi = vector_of<float>(c.wi);
    const auto alpha = alpha_of<float>(c.alpha);
    const Vec3<float> wm = sampler.sample(wi, alpha, u1, u2);
    records.list.push_back({c, vector_of<double>(wm), u1, u2, sampler.pdf(wi, wm, alpha)});
  }
  return records;
}

std::string first_failure(const Verdict& verdict) {
  return verdict.first_failure() == nullptr ? "" : verdict.first_failure()->statistic;
}

bool has(const Verdict& verdict, const std::string& check) {
  return std::any_of(verdict.results.begin(), verdict.results.end(),
                     [&](const CheckResult& f) { return f.check == check; });
}

}  // namespace

TEST_CASE("records are read with and without random numbers and density") {
  const Records all = read("wx,wy,wz,ax,ay,u1,u2,mx,my,mz,pdf\n0,0,1,0.5,0.25,0.1,0.2,0,0,1,3\n");
  REQUIRE(all.list.size() == 1);
  CHECK(all.has_u);
  CHECK(all.has_pdf);
  CHECK(all.list[0].configuration.alpha.y == 0.25);
  CHECK(all.list[0].u2 == 0.2);
  CHECK(all.list[0].pdf == 3);
  const Records tilted = read(kSurfaceHeader + "0,0.6,-0.8,1,2,-0.5,0.7,-0.4,0,-0.6,0.8\n");
  CHECK(tilted.list[0].configuration.alpha.y == 2);
  CHECK(tilted.list[0].configuration.correlation == -0.5);
  CHECK(tilted.list[0].configuration.mean.x == 0.7);
  CHECK(tilted.list[0].configuration.mean.y == -0.4);
  CHECK(tilted.list[0].configuration.wi.z == -0.8);
  CHECK(tilted.list[0].wm.y == -0.6);
  const Records few = read("wx,wy,wz,ax,ay,mx,my,mz\n# comment\n\n0,0.6,0.8,1,1,0,-0.6,0.8\n");
  CHECK_FALSE(few.has_u);
  CHECK(few.list[0].wm.y == -0.6);
}

TEST_CASE("unusable records are refused with line and rule") {
  check_refused("", "it is empty");
  check_refused("wx,wy\n", "line 1: the header 'wx,wy' is not known");
  check_refused(kHeader + "0,0,1,1,1,0.5,0.5,0,0\n", "line 2: it has 9 fields");
  check_refused(kHeader + "0,0,1,1,1,0.5,0.5,0,0,nan\n", "line 2: 'nan' is not a finite number");
  check_refused(kHeader + "0,0,1,1,1,0.5,0.5,0,0,x\n", "'x' is not a finite number");
  check_refused(kHeader + "0,0,2,1,1,0.5,0.5,0,0,1\n", "wx,wy,wz must have length 1");
  check_refused(kSurfaceHeader + "0,0,1,1,1,1,0,0,0,0,1\n",
                "line 2: correlation must be inside (-1, 1)");
  check_refused(kSurfaceHeader + "0,0,1,1,1,0,0,2e9,0,0,1\n",
                "line 2: mean_x and mean_y must be from -1e9 to 1e9");
  check_refused("wx,wy,wz,ax,ay,correlation,mx,my,mz\n",
                "correlation,mean_x,mean_y may stand after ay");
  check_refused(kHeader + "0,0,1,0,1,0.5,0.5,0,0,1\n", "ax and ay must be from 1e-9 to 1e9");
  check_refused(kHeader + "0,0,1,1,2e9,0.5,0.5,0,0,1\n", "ax and ay must be from 1e-9 to 1e9");
  check_refused(kHeader + "0,0,1,1,1,0.5,1.5,0,0,1\n", "u1 and u2 must be in [0, 1]");
  check_refused(kHeader + "0,0,1,1,1,0.5,0.5,0,0,0.9\n", "mx,my,mz must have length 1");
}

TEST_CASE("of more records than are kept, each is kept with the same probability") {
  std::string text = kHeader;
  for (int k = 0; k < 20000; ++k)
    text += "0,0,1,1,1," + std::to_string((k + 0.5) / 20000) + ",0.5,0,0,1\n";
  std::istringstream stream(text), again(text), all(text);
  const Records some = read_records(stream, "r", 1000);
  CHECK(some.read == 20000);
  REQUIRE(some.list.size() == 1000);
  double sum = 0;
  for (const Record& r : some.list) sum += r.u1;
  // The mean of 1000 uniform numbers: five of its standard deviations sqrt(1 / 12000).
  CHECK(sum / 1000 == Approx(0.5).margin(5 * std::sqrt(1.0 / 12000)));
  CHECK(read_records(again, "r", 1000).list[17].u1 == some.list[17].u1);
  CHECK(read_records(all, "r", 20000).list.back().u1 == Approx(0.999975));
}

TEST_CASE("records that were left out are told") {
  Records records = draw(CapsGgx<float>{}, {.count = 1000});
  const auto told = [&] {
    const Verdict v = validate_records(records, *exact_slopes("ggx"), {});
    return std::any_of(v.skipped.begin(), v.skipped.end(), [](const SkippedCheck& s) {
      return s.reason.find("1500 of the 2500 records are in no check") == 0;
    });
  };
  CHECK_FALSE(told());
  records.read = 2500;
  CHECK(told());
}

TEST_CASE("records of an exact sampler that is no monotone map are accepted, its map not checked") {
  for (const bool one : {false, true}) {
    const Verdict v = validate_records(draw(CapsGgx<float>{}, {.one_configuration = one}),
                                       *exact_slopes("ggx"), {});
    CHECK(first_failure(v) == "");
    CHECK_FALSE(has(v, "inverse"));
  }
}

TEST_CASE("records of surfaces and of directions of the whole sphere are judged") {
  const auto& built = small_tables("ggx");
  const TabulatedSampler<float> ggx(built.tables);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<float> uniform;
  Records records{.list = {}, .has_u = true, .has_pdf = true, .read = 50000};
  for (std::size_t k = 0; k < records.read; ++k) {
    const float r = k % 2 == 0 ? -0.95f : 0.5f;
    const Configuration c = at_angles(180 * uniform(random), 360 * uniform(random), 0.5, 0.3, r,
                                      k % 3 == 0 ? Vec2<double>{0, 0} : Vec2<double>{0.7, -0.4});
    const OnSurface on(ggx, rough_surface<float>(c.surface()));
    const auto wi = vector_of<float>(c.wi);
    const float u1 = uniform(random), u2 = uniform(random);
    const Vec3<float> wm = on.sample(wi, u1, u2);
    records.list.push_back({c, vector_of<double>(wm), u1, u2, on.pdf(wi, wm)});
  }
  const Bounds bounds = bounds_of(built.certificate, 96);
  const RecordOptions options{.u_error = 2 * bounds.u_error, .declared = bounds.declared};
  const auto slopes = exact_slopes("ggx");
  const Verdict v = validate_records(records, *slopes, options);
  for (const CheckResult& f : v.results) {
    CAPTURE(f.check, f.statistic, f.measured, f.bound, f.where.theta, f.where.correlation, f.note);
    CHECK(f.passed());
  }
  CHECK(has(v, "inverse"));

  Records wrong = records;
  for (Record& r : wrong.list) r.configuration.correlation += 0.01;
  CHECK_FALSE(validate_records(wrong, *slopes, options).passed());
  wrong = records;
  for (Record& r : wrong.list) r.configuration.mean.y = 0;
  CHECK_FALSE(validate_records(wrong, *slopes, options).passed());
}

TEST_CASE("records of directions that see nothing are left out, and told") {
  Records records = draw(CapsGgx<float>{}, {.count = 1000});
  for (int k = 0; k < 50; ++k)
    records.list.push_back({{{0, 0, -1}, {1, 1}}, {0, 0, 1}, 0.5, 0.5, 0});
  records.read = records.list.size();
  const auto told = [](const Verdict& v) { return v.skipped.back().reason; };
  CHECK_THAT(told(validate_records(records, *exact_slopes("ggx"), {})),
             contains("50 records are in no check: less than 1e-12"));
  records.list.erase(records.list.begin(), records.list.begin() + 950);
  CHECK_THROWS_WITH(validate_records(records, *exact_slopes("ggx"), {}),
                    contains("there are 50 records of which normals are visible"));
}

TEST_CASE("a monotone map is detected and checked to 1e-5") {
  const Records records = draw(InverseBeckmann<float>{}, {.count = 5000});
  const auto slopes = exact_slopes("beckmann");
  const Verdict good = validate_records(records, *slopes, {});
  CHECK(first_failure(good) == "");
  CHECK(has(good, "inverse"));
  Records moved = records;
  for (Record& r : moved.list) r.u1 = std::min(1.0, r.u1 + 2e-5);
  CHECK(first_failure(validate_records(moved, *slopes, {})) == "u-error of slope x");
  CHECK_FALSE(has(validate_records(records, *slopes, {.monotone_inverse = false}), "inverse"));
}

TEST_CASE("records against another distribution are rejected, with theta and alpha") {
  Records records = draw(CapsGgx<float>{}, {.one_configuration = true});
  records.has_pdf = false;
  const Verdict v = validate_records(records, *exact_slopes("beckmann"), {});
  REQUIRE(v.first_failure() != nullptr);
  CHECK(v.first_failure()->where.theta == Approx(70).epsilon(1e-6));
  CHECK(v.first_failure()->where.alpha_y == Approx(0.2).epsilon(1e-6));
}

TEST_CASE("an error at grazing incidence alone is found in its band") {
  Records records = draw(CapsGgx<float>{}, {.count = 100000});
  records.has_pdf = false;
  const CapsGgx<float, BrokenTurn> broken;
  for (Record& r : records.list)
    if (r.configuration.theta() > 85)
      r.wm = vector_of<double>(broken.sample(vector_of<float>(r.configuration.wi),
                                             alpha_of<float>(r.configuration.alpha),
                                             static_cast<float>(r.u1), static_cast<float>(r.u2)));
  const Verdict v = validate_records(records, *exact_slopes("ggx"), {});
  REQUIRE(v.first_failure() != nullptr);
  CHECK(v.first_failure()->where.theta > 85);
}

TEST_CASE("a wrong density, a normal below the horizon and one that faces away are rejected") {
  const auto slopes = exact_slopes("ggx");
  const Records good = draw(CapsGgx<float>{}, {.count = 2000});
  Records records = good;
  records.list[17].pdf *= 1.01;
  CHECK(first_failure(validate_records(records, *slopes, {})) == "pdf");
  records = good;
  records.list[17].wm.z = -records.list[17].wm.z;
  CHECK(first_failure(validate_records(records, *slopes, {})) == "below the horizon");
  records = good;
  records.list[17].wm = {-1, 0, 0};
  records.list[17].configuration.wi = {0.8, 0, 0.6};
  CHECK(first_failure(validate_records(records, *slopes, {})) == "facing away / (1 + alpha mu)");
}

TEST_CASE(
    "samples of all normals are records of their own distribution and not of the visible one") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  Records records;
  for (int k = 0; k < 20000; ++k) {
    const double u = uniform(random), r = std::sqrt(u / (1 - u));
    const double phi = 2 * std::numbers::pi * uniform(random), length = std::hypot(1, r);
    const Vec3<double> wm{r * std::cos(phi) / length, r * std::sin(phi) / length, 1 / length};
    records.list.push_back({at_angles(40, 0, 1, 1), wm});
  }
  const auto slopes = exact_slopes("ggx");
  CHECK(first_failure(validate_records(records, *slopes, {.normals = SampledNormals::all})) == "");
  CHECK(first_failure(validate_records(records, *slopes, {})) != "");
}

TEST_CASE("what records cannot show is told, and no check is left out in silence") {
  const auto reason = [](const Verdict& v, const std::string& check, const std::string& statistic) {
    for (const SkippedCheck& s : v.skipped)
      if (s.check == check && s.statistic == statistic) return s.reason;
    return std::string();
  };
  const auto slopes = exact_slopes("ggx");
  Records records = draw(CapsGgx<float>{}, {.count = 1000, .one_configuration = true});
  records.has_pdf = records.has_u = false;
  const Verdict few = validate_records(records, *slopes, {});
  CHECK_THAT(reason(few, "density", "pdf"), contains("no column pdf"));
  CHECK_THAT(reason(few, "inverse", ""), contains("no random numbers u1,u2"));
  CHECK_THAT(reason(few, "worst group", ""), contains("one configuration"));
  for (const std::string name : {"radius tails", "azimuth tails", "slope x tails"})
    CHECK_THAT(reason(few, "distribution", name), contains("it takes 2048 records"));
  CHECK_THAT(reason(few, "distribution", "azimuth given ax / ay"),
             contains("it takes 800 records of different ax / ay"));
  const Verdict many = validate_records(draw(CapsGgx<float>{}, {.count = 3000}), *slopes, {});
  CHECK(reason(many, "distribution", "radius tails").empty());
  CHECK(reason(many, "distribution", "azimuth given ax / ay").empty());
  CHECK(reason(many, "density", "pdf").empty());
  records.has_u = true;
  const Verdict all = validate_records(records, *slopes, {.normals = SampledNormals::all});
  CHECK_THAT(reason(all, "inverse", ""), contains("only maps to visible normals"));
  CHECK_FALSE(has(all, "inverse"));
  CHECK_THAT(reason(all, "normals", "facing away / (1 + alpha mu)"), contains("all normals"));
}

TEST_CASE("counts say what each group can show, and which records are in none") {
  const std::vector<Configuration> list{at_angles(10, 0, 0.5, 0.5), at_angles(50, 0, 0.5, 0.5),
                                        at_angles(80, 0, 0.5, 0.5)};
  Records records = draw_records(CapsGgx<float>{}, std::span{list}.first(1), 700, 2);
  for (const auto& [place, count] : {std::pair<std::size_t, std::size_t>{1, 300}, {2, 99}}) {
    const auto more = draw_records(CapsGgx<float>{}, std::span{list}.subspan(place, 1), count, 3);
    records.list.insert(records.list.end(), more.list.begin(), more.list.end());
  }
  const Verdict v = validate_records(records, *exact_slopes("ggx"), {});
  REQUIRE(v.resolutions.size() == 3);
  CHECK(v.resolutions[0].samples == 1099);
  CHECK(v.resolutions[1].samples == 700);
  CHECK(v.resolutions[1].counted == "the largest configuration");
  CHECK(v.resolutions[2].samples == 300);
  const double p = result_of(v, "worst group", "radius cdf").bound;
  CHECK(v.resolutions[2].u_error == visible_u_error(300, p));
  CHECK(v.resolutions[2].bin_error == visible_bin_error(300, bins_for(300).line));
  const bool told = std::any_of(v.skipped.begin(), v.skipped.end(), [](const SkippedCheck& s) {
    return s.check == "worst group" &&
           s.reason.find("99 records are in 1 configuration of fewer than 100") == 0;
  });
  CHECK(told);
}

TEST_CASE("the failure that is farthest beyond its bound is named first, of the first check") {
  Verdict v;
  CHECK(v.failures().empty());
  v.results = {{.check = "a", .statistic = "good", .measured = 1, .bound = 2},
               {.check = "a", .statistic = "near", .measured = 3, .bound = 2},
               {.check = "a", .statistic = "far", .measured = 9, .bound = 2},
               {.check = "b", .statistic = "other", .measured = 99, .bound = 2}};
  const auto failures = v.failures();
  REQUIRE(failures.size() == 3);
  CHECK(failures[0].statistic == "far");
  CHECK(failures[1].statistic == "near");
  CHECK(failures[2].statistic == "other");
}

TEST_CASE("too few records are refused") {
  CHECK_THROWS_WITH(
      validate_records(draw(CapsGgx<float>{}, {.count = 99}), *exact_slopes("ggx"), {}),
      contains("there are 99 records; give 100 or more"));
}

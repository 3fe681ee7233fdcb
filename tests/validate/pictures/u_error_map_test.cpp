// An error that is put in by hand is read off the pictures of the u-error, and the u-error check
// sees the same.
#include "vndf/validate/pictures/u_error_map.h"

#include <algorithm>
#include <cmath>

#include "support/built_tables.h"
#include "support/catch.h"
#include "support/samplers_under_test.h"
#include "vndf/validate/checks/u_error_check.h"
#include "vndf/validate/sampler/named_samplers.h"

using namespace vndf;
using namespace vndf::validate;
using namespace vndf::test;

namespace {

constexpr double kAmount = 1e-3;

double moved(double u) {
  return u + kAmount * u * (1 - u);
}

/// The exact map at other random numbers: its u-error is kAmount u (1 - u), of both slopes.
SamplerUnderTest moved_beckmann() {
  SamplerUnderTest s =
      under_test<double>("moved", exact_slopes("beckmann"), InverseBeckmann<double>{},
                         Claims{.monotone_inverse = true});
  const InverseBeckmann<double> exact;
  s.sample = [exact](const Configuration& c, std::span<const RandomPair> u,
                     std::span<Vec3<double>> wm) {
    for (std::size_t k = 0; k < u.size(); ++k)
      wm[k] = exact.sample(c.wi, c.alpha, moved(u[k].x), moved(u[k].y));
  };
  return s;
}

/// Largest difference between the errors of `map` and those put in.
double farthest_from_moved(const UErrorMap& map) {
  double farthest = 0;
  for (std::size_t j = 0; j < map.error.rows; ++j)
    for (std::size_t i = 0; i < map.error.columns; ++i)
      farthest = std::max(farthest, std::abs(map.error.at(i, j) - (moved(map.u[i]) - map.u[i])));
  return farthest;
}

bool is_unknown(double v) {
  return std::isnan(v);
}

}  // namespace

TEST_CASE("places in logit(u) are symmetric and increase from tail to tail") {
  const auto places = logit_places(201);
  CHECK(places.front() == Approx(kSmallestShownU));
  CHECK(1 - places.back() == Approx(kSmallestShownU).epsilon(0.5));  // of the last two numbers
  CHECK(places[100] == 0.5);
  CHECK(std::is_sorted(places.begin(), places.end()));
  for (std::size_t k = 0; k < 60; ++k) CHECK(1 - places[200 - k] == Approx(places[k]).margin(6e-8));
}

TEST_CASE("the error put into a map is read off for slope x at every incidence") {
  const UErrorMap map = marginal_error_map(moved_beckmann(), 13, 41, {});
  CHECK(map.row.front() == 0);
  CHECK(map.row.back() == 90);
  CHECK(farthest_from_moved(map) < 1e-9);
}

TEST_CASE("the error put into a map is read off for slope y, less the rounding of slopes") {
  const UErrorMap map = conditional_error_map(moved_beckmann(), 45, 9, 41, {});
  CHECK(farthest_from_moved(map) < 1e-6);
}

TEST_CASE("the largest errors of the pictures are those that the u-error check finds") {
  // Other places: the validator's are fewer, but at more incidences.
  const auto& built = small_tables("k:nu=1");
  const SamplerUnderTest tables =
      tables_under_test("k", exact_slopes("k:nu=1"), built.tables, built.certificate);
  const auto results = check_u_error(tables, {.places = 150, .slopes = 3, .stride = 2});
  const auto checked = [&](const std::string& statistic) {
    const auto f = std::find_if(results.begin(), results.end(),
                                [&](const CheckResult& one) { return one.statistic == statistic; });
    REQUIRE(f != results.end());
    return f->measured;
  };
  const double x = largest(marginal_error_map(tables, 61, 101, {}).error);
  const double y = largest(conditional_error_map(tables, 45, 61, 101, {}).error);
  const double checked_x = checked("u-error of slope x"), checked_y = checked("u-error of slope y");
  CAPTURE(x, checked_x, y, checked_y);
  CHECK(x > 0.7 * checked_x);
  CHECK(x < 1.4 * checked_x);
  CHECK(y > 0.7 * checked_y);
  CHECK(y < 1.4 * checked_y);
}

TEST_CASE("where no map is claimed nothing is said of it") {
  const auto& named = find_sampler("ggx-analytic");  // claims one outside a cone
  const SamplerUnderTest analytic = named.make(named.name, exact_slopes("ggx"));
  const Grid marginal = marginal_error_map(analytic, 91, 21, {}).error;
  CHECK(std::all_of(marginal.values.begin(), marginal.values.begin() + 21, is_unknown));
  CHECK(std::none_of(marginal.values.begin() + 21, marginal.values.end(), is_unknown));
  const Grid conditional = conditional_error_map(analytic, 0, 5, 5, {}).error;
  CHECK(std::all_of(conditional.values.begin(), conditional.values.end(), is_unknown));
}

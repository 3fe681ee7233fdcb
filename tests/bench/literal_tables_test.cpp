// The paper's layout read literally: its nodes against closed forms, its error against figures
// found by another program, and the measurement against tables made wrong on purpose.
#include "vndf/bench/literal_tables.h"

#include <cmath>
#include <memory>

#include "support/catch.h"
#include "support/visible_normals.h"
#include "vndf/distributions/parse_distribution.h"

using namespace vndf;
using namespace vndf::bench;
using namespace vndf::test;

namespace {

/// The u-errors of 1024 x 1024 tables, of two digits, and how far another choice of the places at
/// which the error is looked for may move them.
constexpr double kBeckmannError = 5.9e-4, kGgxError = 9.6e-4, kPlaces = 0.03;
/// A node is a float.
constexpr double kNodeError = 3e-7;

struct Made {
  explicit Made(const std::string& spec, std::size_t side)
      : distribution(distributions::parse_distribution(spec)),
        slopes(*distribution, {}),
        tables(make_literal_tables(slopes, side, {})) {}

  std::unique_ptr<distributions::SlopeDistribution> distribution;
  precompute::UnitSlopes slopes;
  std::shared_ptr<const LiteralTables> tables;
};

template <class Forms>
void check_nodes(const std::string& spec) {
  constexpr std::size_t kSide = 33;
  const Made made(spec, kSide);
  const double step = 1.0 / (kSide - 1);
  for (std::size_t i = 0; i < kSide; ++i)
    for (std::size_t j = 1; j + 1 < kSide; ++j) {
      const double theta = static_cast<double>(i) * step * std::numbers::pi / 2;
      const double u = static_cast<double>(j) * step;
      const double x = made.tables->x[i * kSide + j];
      REQUIRE(std::abs(visible_cdf<Forms>(std::cos(theta), std::sin(theta), x) - u) < kNodeError);
      if (i == 0 || i + 1 == kSide) continue;
      const double row = std::tan(std::numbers::pi * (static_cast<double>(i) * step - 0.5));
      const double y = made.tables->y[i * kSide + j];
      REQUIRE(std::abs(Forms::conditional(row, y) - u) < kNodeError);
    }
}

/// The u-error of `made` with slopes x multiplied by `factor`.
double scaled_error(const Made& made, float factor) {
  auto wrong = std::make_shared<LiteralTables>(*made.tables);
  for (float& x : wrong->x) x *= factor;
  return measure_literal(made.slopes, wrong, {}).max_u_error;
}

}  // namespace

TEST_CASE("nodes of literal tables are quantiles by closed forms") {
  check_nodes<GgxForms>("ggx");
  check_nodes<BeckmannForms>("beckmann");
}

TEST_CASE("the ends of u hold the slopes of the last u, and rows beyond all samples the nearest") {
  const Made made("beckmann", 65);
  const auto& t = *made.tables;
  CHECK(visible_cdf<BeckmannForms>(1, 0, t.x[0]) == Approx(kLiteralEnd).epsilon(1e-4));
  CHECK(t.x[64] == Approx(-t.x[0]).epsilon(1e-6));
  for (std::size_t j = 0; j < 65; ++j) {
    CHECK(std::isfinite(t.y[j]));
    CHECK(t.y[j] == t.y[65 + j]);
    CHECK(t.y[j] == t.y[64 * 65 + j]);
  }
}

TEST_CASE("the literal tables of 1024 x 1024 err by what was found before") {
  const auto error = [](const char* spec) {
    const Made made(spec, 1024);
    return measure_literal(made.slopes, made.tables, {}).max_u_error;
  };
  CHECK(error("beckmann") == Approx(kBeckmannError).epsilon(kPlaces));
  CHECK(error("ggx") == Approx(kGgxError).epsilon(kPlaces));
}

TEST_CASE("the errors of literal tables show slopes that are 5 % too large") {
  const Made made("ggx", 128);
  const double right = measure_literal(made.slopes, made.tables, {}).max_u_error;
  CHECK(scaled_error(made, 1) == right);
  // At normal incidence the CDF at the slope 1 has the density P(1) = 0.18: 5 % move it by 0.009.
  CHECK(scaled_error(made, 1.05f) > std::max(right, 0.008));
}

TEST_CASE("a literal sampler gives the slopes of its nodes") {
  const Made made("ggx", 65);
  const LiteralSampler<double> sampler(made.tables);
  const double theta = std::numbers::pi / 2 * 20 / 64;
  const Vec3<double> wi{std::sin(theta), 0, std::cos(theta)};
  const Vec3<double> m = sampler.sample(wi, {1, 1}, 16.0 / 64, 48.0 / 64);
  const Vec2<double> slope = slope_of(m);
  CHECK(slope.x == Approx(made.tables->x[20 * 65 + 16]).epsilon(1e-6));
  CHECK(slope.y == Approx(sampler.sample_y(slope.x, 48.0 / 64)).epsilon(1e-6));
}

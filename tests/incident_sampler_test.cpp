// The sampler of one incident direction draws what the sampler of any draws.
#include "vndf/incident_sampler.h"

#include <cmath>
#include <limits>
#include <memory>

#include "batch_judge.h"
#include "batch_tables.h"
#include "catch.h"
#include "random_inputs.h"

using namespace vndf;
using namespace vndf::test;

namespace {

/// Largest angle at unit roughness between the two samplers, in roundings of 1, less that by which
/// as many roundings of u1 as are allowed turn the normal.
template <class T>
double worst_roundings(const std::shared_ptr<const SlopeTables>& tables) {
  const TabulatedSampler<T> sampler(tables);
  RandomInputs random(23);
  const double rounding = std::numeric_limits<T>::epsilon();
  const T step = static_cast<T>(kIncidentRoundings * rounding);
  double worst = -1;
  for (int k = 0; k < 2000; ++k) {
    const SamplerInput in = random.hard();
    const Vec3<T> wi{static_cast<T>(in.wi.x), static_cast<T>(in.wi.y), static_cast<T>(in.wi.z)};
    const Alpha<T> alpha{static_cast<T>(in.alpha.x), static_cast<T>(in.alpha.y)};
    const T u1 = static_cast<T>(in.u1), u2 = static_cast<T>(in.u2);
    const Alpha<double> unit{in.alpha.x * tables->mean_slope, in.alpha.y * tables->mean_slope};
    const auto expected = sampler.sample(wi, alpha, u1, u2);
    double allowed = 0;
    for (const T moved : {u1 - step, u1 + step})
      allowed =
          std::max(allowed, stretched_angle(sampler.sample(wi, alpha, moved, u2), expected, unit));
    const auto sampled = IncidentSampler<T>(sampler, wi, alpha).sample(u1, u2);
    worst = std::max(worst, (stretched_angle(sampled, expected, unit) - allowed) / rounding);
  }
  return worst;
}

}  // namespace

TEST_CASE("one incident direction at a time gives the normals of the sampler of any direction") {
  for (const auto& t : all_kinds_of_tables()) {
    CAPTURE(t->distribution);
    CHECK(worst_roundings<float>(t) <= kIncidentRoundings);
    CHECK(worst_roundings<double>(t) <= kIncidentRoundings);
  }
}

TEST_CASE("the rows around a coordinate and their weights give the rows back at the nodes") {
  const QuantileTable table = power_table(9, 5, RowBlend::cubic);
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const auto rows = weighted_rows(table, static_cast<double>(i) / 8);
    REQUIRE(rows.count == 4);
    for (std::size_t r = 0; r < 4; ++r)
      CHECK(rows.weights[r] == Approx(rows.first + r == i ? 1 : 0).margin(1e-15));
  }
}

TEST_CASE("tables in double precision are read in double precision") {
  SlopeTables tables = plain_tables();
  const QuantileTable single = tables.marginal;
  std::vector<double> values;
  for (std::size_t i = 0; i < single.rows(); ++i)
    for (std::size_t j = 0; j < single.columns(); ++j)
      values.push_back(j == 0 ? 0 : double{single.row(i)[j].value} * (1 - 1e-9));
  tables.marginal =
      QuantileTable::with_double_values(single.rows(), single.columns(), values, single.blend());
  CHECK(worst_roundings<double>(share(tables)) <= kIncidentRoundings);
}

TEST_CASE("an incident direction below the horizon or a roughness out of range gives (0, 0, 1)") {
  const TabulatedSampler<float> sampler(share(plain_tables()));
  for (const auto& incident : {IncidentSampler<float>(sampler, {0, 0, -1}, {1, 1}),
                               IncidentSampler<float>(sampler, {0, 0, 1}, {0, 1}),
                               IncidentSampler<float>(sampler, {NAN, 0, 1}, {1, 1})}) {
    const auto m = incident.sample(0.25f, 0.75f);
    CHECK(m.x == 0);
    CHECK(m.y == 0);
    CHECK(m.z == 1);
  }
}

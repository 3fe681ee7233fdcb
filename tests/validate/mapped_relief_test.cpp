// The visible normals of a normal map by brute force: those of its own texels, weighted by how much
// of each is seen. Compared with them are the normals of tables that are built from the map, on the
// surface that the map reports.
//
// The toolkit describes a map by a distribution of one radius, which is right where slopes are
// elliptical about their mean. Real reliefs are so in part only. Those here are: slopes of many
// random waves are Gaussian, and where tiles of the map have different amplitudes they become a
// scale mixture of Gaussians, which is elliptical too and has a heavier tail. The wave numbers are
// whole, so that the map has a period and its covariance has no noise of sampling.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "support/catch.h"
#include "vndf/distributions/slope_map.h"
#include "vndf/on_surface.h"
#include "vndf/precompute/build_tables.h"
#include "vndf/surface_slopes.h"
#include "vndf/tabulated_sampler.h"
#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/statistics/quasi_random.h"
#include "vndf/validate/validate_records.h"

using namespace vndf;
using namespace vndf::validate;

namespace {

constexpr std::size_t kSide = 1024, kTexels = kSide * kSide;
constexpr Vec2<double> kMean{0.7, -0.4};

using Slopes = std::vector<Vec2<double>>;

/// Ripples of a tilted plane: three octaves of waves whose crests lie around 35 degrees, twice as
/// long along them as across.
Slopes ripples() {
  constexpr int kWaves = 120;
  constexpr double kSlope = 0.6;  // root mean square, across
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> normal;
  std::vector<double> sine(kSide);
  for (std::size_t k = 0; k < kSide; ++k)
    sine[k] = std::sin(2 * std::numbers::pi * static_cast<double>(k) / kSide);
  Slopes slopes(kTexels, {0, 0});
  const double c = std::cos(35 * kDegree), s = std::sin(35 * kDegree);
  for (int wave = 0; wave < kWaves; ++wave) {
    const double octave = 100 * (1 << (wave % 3));
    const double across = octave * normal(random), along = octave / 2 * normal(random);
    const auto kx = static_cast<int>(std::lround(-s * across + c * along));
    const auto ky = static_cast<int>(std::lround(c * across + s * along));
    const double size = kSlope * std::sqrt(2.0 / kWaves) / octave;
    const double ax = size * kx, ay = size * ky;
    const auto shift = static_cast<int>(uniform(random) * kSide);
    for (std::size_t j = 0; j < kSide; ++j)
      for (std::size_t i = 0; i < kSide; ++i) {
        const int phase = kx * static_cast<int>(i) + ky * static_cast<int>(j) + shift;
        const double wave_here = sine[static_cast<unsigned>(phase) % kSide];
        slopes[j * kSide + i].x += ax * wave_here;
        slopes[j * kSide + i].y += ay * wave_here;
      }
  }
  return slopes;
}

/// Tiles whose amplitudes have a Gamma distribution.
void roughen_tiles(Slopes& slopes) {
  constexpr std::size_t kTile = 8, kTiles = kSide / kTile;
  std::mt19937_64 random(6);
  std::gamma_distribution<double> square(2, 0.5);
  std::vector<double> amplitude(kTiles * kTiles);
  for (double& a : amplitude) a = std::sqrt(square(random));
  for (std::size_t k = 0; k < kTexels; ++k) {
    const double a = amplitude[k / kSide / kTile * kTiles + k % kSide / kTile];
    slopes[k] = {a * slopes[k].x, a * slopes[k].y};
  }
}

void tilt(Slopes& slopes) {
  for (Vec2<double>& s : slopes) s = {s.x + kMean.x, s.y + kMean.y};
}

/// The area that each texel shows to wi.
std::vector<double> visible_areas(const Slopes& slopes, const Vec3<double>& wi) {
  std::vector<double> areas;
  for (const Vec2<double>& s : slopes)
    areas.push_back(std::max(0.0, wi.z - wi.x * s.x - wi.y * s.y));
  return areas;
}

std::vector<Vec3<double>> normals_of(const Slopes& slopes) {
  std::vector<Vec3<double>> normals;
  for (const Vec2<double>& s : slopes) {
    const double length = std::sqrt(s.x * s.x + s.y * s.y + 1);
    normals.push_back({-s.x / length, -s.y / length, 1 / length});
  }
  return normals;
}

/// Four incidences: from near the mean facet's normal, from the side, grazing, and from below it.
std::vector<Configuration> incidences(const SurfaceSlopes& slopes) {
  std::vector<Configuration> list;
  for (const auto& [theta, phi] : {std::pair{10.0, 0.0}, std::pair{50.0, 120.0},
                                   std::pair{85.0, 250.0}, std::pair{95.0, 30.0}}) {
    Configuration c =
        at_angles(theta, phi, slopes.alpha.x, slopes.alpha.y, slopes.correlation, slopes.mean);
    const double z = c.wi.z + c.wi.x * c.mean.x + c.wi.y * c.mean.y;
    const double length = std::hypot(c.wi.x, c.wi.y, z);
    c.wi = {to_single(c.wi.x / length), to_single(c.wi.y / length), to_single(z / length)};
    list.push_back(c);
  }
  return list;
}

/// A map with what the toolkit makes of it.
struct Mapped {
  Slopes slopes;
  std::vector<Vec3<double>> normals;
  distributions::SlopeMapStatistics statistics;
  SurfaceSlopes surface;
  precompute::BuiltTables built;
  ExactSlopes exact;
};

Mapped mapped(Slopes slopes) {
  auto estimate = distributions::estimate_slope_map(slopes);
  const SurfaceSlopes surface = estimate.statistics.surface;
  auto built = precompute::build_tables(*estimate.distribution, {.layout = {64, 96, false}});
  ExactSlopes exact(
      std::make_unique<distributions::MeasuredProfile>(std::move(*estimate.distribution)));
  auto normals = normals_of(slopes);
  return {std::move(slopes), std::move(normals), estimate.statistics,
          surface,           std::move(built),   std::move(exact)};
}

const Mapped& relief() {
  static const Mapped map = [] {
    Slopes slopes = ripples();
    roughen_tiles(slopes);
    tilt(slopes);
    return mapped(std::move(slopes));
  }();
  return map;
}

/// The distance that CDFs of as many independent texels as are seen from one direction keep, but
/// for the probability kRunSignificance (Dvoretzky, Kiefer and Wolfowitz; Massart 1990): the error
/// of SlopeMapStatistics::u_error, at this direction and this probability.
double statistical_error(const std::vector<double>& areas) {
  double sum = 0, squares = 0;
  for (const double a : areas) {
    sum += a;
    squares += a * a;
  }
  return std::sqrt(std::log(2 / kRunSignificance) / 2 * squares) / sum;
}

/// The largest distance between the CDFs of the texels' normals, each with its weight, and of the
/// normals of tables on `surface`, along an axis.
double distance_along(const Vec3<double>& axis, const Mapped& map, const std::vector<double>& areas,
                      const std::vector<Vec3<double>>& drawn) {
  constexpr std::size_t kBins = 4000;
  const auto bin_of = [&](const Vec3<double>& m) {
    return std::min(kBins - 1, static_cast<std::size_t>((dot(m, axis) + 1) / 2 * kBins));
  };
  std::vector<double> bins(kBins, 0);
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  for (std::size_t k = 0; k < kTexels; ++k) bins[bin_of(map.normals[k])] += areas[k] / area;
  for (const Vec3<double>& m : drawn) bins[bin_of(m)] -= 1 / static_cast<double>(drawn.size());
  double sum = 0, farthest = 0;
  for (const double b : bins) farthest = std::max(farthest, std::abs(sum += b));
  return farthest;
}

/// The largest over several axes at one incidence, for normals that are drawn on `surface`.
double distance(const Mapped& map, const Vec3<double>& wi, const std::vector<double>& areas,
                const SurfaceSlopes& surface) {
  constexpr std::size_t kDrawn = 200000;
  const TabulatedSampler<float> sampler(map.built.tables);
  const OnSurface on(sampler, surface.surface<float>());
  std::vector<Vec3<double>> drawn;
  for (std::size_t k = 0; k < kDrawn; ++k) {
    const RandomPair u = quasi_random_point(k);
    drawn.push_back(vector_of<double>(
        on.sample(vector_of<float>(wi), static_cast<float>(u.x), static_cast<float>(u.y))));
  }
  double farthest = 0;
  for (const Vec3<double>& axis :
       {Vec3<double>{1, 0, 0}, {0, 1, 0}, {0.6, 0.8, 0}, {0.8, -0.6, 0}, {0.48, 0.6, 0.64}})
    farthest = std::max(farthest, distance_along(axis, map, areas, drawn));
  return farthest;
}

/// `count` texels at each incidence, drawn by their areas, as records of `surface`.
Records drawn_texels(const Mapped& map, const SurfaceSlopes& surface, std::size_t count) {
  std::mt19937_64 random(7);
  Records records;
  for (const Configuration& c : incidences(map.surface)) {
    const auto areas = visible_areas(map.slopes, c.wi);
    std::discrete_distribution<std::size_t> texel(areas.begin(), areas.end());
    for (std::size_t k = 0; k < count; ++k)
      records.list.push_back(
          {{c.wi, surface.alpha, surface.correlation, surface.mean}, map.normals[texel(random)]});
  }
  records.read = records.list.size();
  return records;
}

SurfaceSlopes without_correlation(SurfaceSlopes s) {
  s.correlation = 0;
  return s;
}
SurfaceSlopes without_mean(SurfaceSlopes s) {
  s.mean = {0, 0};
  return s;
}

}  // namespace

TEST_CASE("a relief is well away from a flat surface") {
  const SurfaceSlopes& surface = relief().surface;
  CHECK(std::abs(surface.correlation) > 0.5);
  CHECK(surface.mean.x == Approx(kMean.x).epsilon(0.01));
  CHECK(surface.mean.y == Approx(kMean.y).epsilon(0.01));
}

TEST_CASE("tables on the surface of a relief draw the visible normals of its texels") {
  for (const Configuration& c : incidences(relief().surface)) {
    const auto areas = visible_areas(relief().slopes, c.wi);
    const double bound = statistical_error(areas);
    CAPTURE(c.theta(), bound);
    CHECK(bound < 0.01);
    CHECK(distance(relief(), c.wi, areas, relief().surface) < bound);
    CHECK(distance(relief(), c.wi, areas, without_correlation(relief().surface)) > 10 * bound);
    CHECK(distance(relief(), c.wi, areas, without_mean(relief().surface)) > 10 * bound);
  }
}

TEST_CASE("the validator accepts texels of a relief as normals of its distribution and surface") {
  // Few enough that the same texel, or one beside it, is seldom drawn twice.
  constexpr std::size_t kCount = 3000;
  const RecordOptions options{.declared = {.u = relief().statistics.u_error}};
  const SurfaceSlopes& surface = relief().surface;
  const Verdict right =
      validate_records(drawn_texels(relief(), surface, kCount), relief().exact, options);
  for (const CheckResult& f : right.results) {
    CAPTURE(f.check, f.statistic, f.measured, f.bound, f.where.theta, f.note);
    CHECK(f.passed());
  }
  for (const SurfaceSlopes& wrong : {without_correlation(surface), without_mean(surface)})
    CHECK_FALSE(
        validate_records(drawn_texels(relief(), wrong, kCount), relief().exact, options).passed());
}

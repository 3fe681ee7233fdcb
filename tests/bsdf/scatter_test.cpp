// The operators reflect and transmit: the physics, the inverses and the Jacobians.
#include "vndf/bsdf/scatter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/bsdf_inputs.h"
#include "support/catch.h"

using namespace vndf;
using namespace vndf::test;

namespace {

/// Rounding of a few products of unit vectors, divided by eta >= 0.2.
constexpr double kRounding = 1e-14;

const std::vector<double> kEtas{0.2, 0.66, 1 - 1e-9, 1 + 1e-9, 1.33, 1.5, 4};

double distance(const Vec3<double>& a, const Vec3<double>& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

Vec3<double> cross(const Vec3<double>& a, const Vec3<double>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Vec3<double> along(const Vec3<double>& a, const Vec3<double>& b, double step) {
  return normalize_or_up(Vec3<double>{a.x + step * b.x, a.y + step * b.y, a.z + step * b.z});
}

/// |d map(m) / d m| on the sphere by central differences.
template <class Map>
double area_ratio(Map map, const Vec3<double>& m) {
  constexpr double kStep = 1e-5;  // rounding 1e-16 / 1e-5, truncation by the fourth power
  const Vec3<double> side = std::abs(m.x) < 0.7 ? Vec3<double>{1, 0, 0} : Vec3<double>{0, 1, 0};
  const Vec3<double> u = normalize_or_up(cross(m, side)), v = cross(m, u);
  const auto difference = [&](const Vec3<double>& t, double step) {
    const Vec3<double> a = map(along(m, t, step)), b = map(along(m, t, -step));
    return Vec3<double>{a.x - b.x, a.y - b.y, a.z - b.z};
  };
  // The central difference of fourth order, because near total reflection the third derivative is
  // 1e5 times the first.
  const auto derivative = [&](const Vec3<double>& t) {
    const Vec3<double> near = difference(t, kStep), far = difference(t, 2 * kStep);
    const auto mean = [&](double a, double b) { return (8 * a - b) / (12 * kStep); };
    return Vec3<double>{mean(near.x, far.x), mean(near.y, far.y), mean(near.z, far.z)};
  };
  const Vec3<double> area = cross(derivative(u), derivative(v));
  return std::sqrt(dot(area, area));
}

/// Largest difference of a component from `exact`.
template <class T>
double error_of(const Vec3<T>& w, const Vec3<long double>& exact) {
  const auto difference = [](T a, long double b) { return static_cast<double>(std::abs(a - b)); };
  return std::max({difference(w.x, exact.x), difference(w.y, exact.y), difference(w.z, exact.z)});
}

/// Against the formulas as the paper prints them, in extended precision.
template <class T>
void check_errors() {
  RandomInputs random(8);
  const auto rounded = [](const Vec3<double>& w) {
    return Vec3<T>{static_cast<T>(w.x), static_cast<T>(w.y), static_cast<T>(w.z)};
  };
  for (int i = 0; i < 100000; ++i) {
    const auto wi = rounded(random_direction(random, 180));
    const auto wm = rounded(random_direction(random, 180));
    const T eta = static_cast<T>(std::pow(10, 2 * random.uniform() - 1));
    const Vec3<long double> w{wi.x, wi.y, wi.z}, m{wm.x, wm.y, wm.z};
    const auto combined = [&](long double a, long double b) {
      return Vec3<long double>{a * m.x - b * w.x, a * m.y - b * w.y, a * m.z - b * w.z};
    };
    const long double c = dot(w, m), n = 1.0L / eta, square = 1 + n * n * (c * c - 1);
    CAPTURE(i, eta, static_cast<double>(c));
    REQUIRE(error_of(reflect(wi, wm), combined(2 * c, 1)) <= kReflectError<T>);
    const auto wo = refract(wi, wm, eta);
    if (!wo || square < 0) continue;
    const long double root = std::sqrt(square);
    const double g = static_cast<double>(eta * root);
    const double bound =
        std::min<double>(kRefractError<T> / std::min(1.0, g), kRefractErrorAtCriticalAngle<T>);
    REQUIRE(error_of(*wo, combined(n * c - (c < 0 ? -root : root), n)) <= bound / eta);
  }
}

}  // namespace

TEST_CASE("reflection and refraction err by no more than is stated") {
  check_errors<float>();
  check_errors<double>();
}

TEST_CASE("reflection keeps the angle to the normal, and twice reflected is the direction itself") {
  RandomInputs random(1);
  for (int i = 0; i < 1000; ++i) {
    const auto wi = random_direction(random, 90), wm = random_direction(random, 180);
    const auto wo = reflect(wi, wm);
    REQUIRE(dot(wo, wm) == Approx(dot(wi, wm)).margin(kRounding));
    REQUIRE(distance(reflect(wo, wm), wi) < kRounding);
    REQUIRE(distance(cross(wi, wm), cross(wm, wo)) < kRounding);
  }
}

TEST_CASE("refraction obeys Snell's law, stays in the plane of incidence and changes sides") {
  RandomInputs random(2);
  for (const double eta : kEtas)
    for (int i = 0; i < 1000; ++i) {
      const auto wi = random_direction(random, 90), wm = random_direction(random, 180);
      const auto wo = refract(wi, wm, eta);
      const auto sine = cross(wi, wm);
      CAPTURE(eta, wi.x, wi.y, wi.z, wm.x, wm.y, wm.z);
      REQUIRE(wo.has_value() == (dot(sine, sine) <= eta * eta));
      if (!wo) continue;
      const auto far_sine = cross(wm, *wo);
      REQUIRE(distance(sine, {eta * far_sine.x, eta * far_sine.y, eta * far_sine.z}) < kRounding);
      REQUIRE(dot(*wo, wm) * dot(wi, wm) <= 0);
      REQUIRE(dot(*wo, *wo) == Approx(1).epsilon(kRounding));
    }
}

TEST_CASE("refraction backwards gives the direction itself") {
  RandomInputs random(3);
  for (const double eta : kEtas)
    for (int i = 0; i < 1000; ++i) {
      const auto wi = random_direction(random, 80), wm = random_direction(random, 30);
      if (std::abs(dot(wi, wm)) < 0.1) continue;  // there the way back has the slope of a root
      const auto wo = refract(wi, wm, eta);
      if (!wo || std::abs(dot(*wo, wm)) < 0.1) continue;
      const auto back = refract(*wo, wm, 1 / eta);
      REQUIRE(back);
      REQUIRE(distance(*back, wi) < 100 * kRounding);
    }
}

TEST_CASE("at equal indices every facet refracts straight on") {
  RandomInputs random(4);
  for (int i = 0; i < 100; ++i) {
    const auto wi = random_direction(random, 90);
    const auto wo = refract(wi, random_direction(random, 180), 1.0);
    REQUIRE(wo);
    REQUIRE((wo->x == -wi.x && wo->y == -wi.y && wo->z == -wi.z));
  }
  CHECK(refract(Vec3<double>{1, 0, 0}, Vec3<double>{0, 0, 1}, 1.0));
}

/// Calls `check(wi, wm)` for those of `count` random pairs in which the normal is seen under a
/// cosine of at least `least`.
template <class Check>
void for_seen_normals(unsigned seed, int count, double least, Check check) {
  RandomInputs random(seed);
  for (int i = 0; i < count; ++i) {
    const auto wi = random_direction(random, 80), wm = random_direction(random, 60);
    if (dot(wi, wm) >= least) check(wi, wm);
  }
}

TEST_CASE("half vectors undo reflection and refraction") {
  for_seen_normals(5, 1000, 0.1, [](const Vec3<double>& wi, const Vec3<double>& wm) {
    const auto wo = reflect(wi, wm);
    if (wo.z > 0) REQUIRE(distance(reflection_half_vector(wi, wo), wm) < 100 * kRounding);
    for (const double eta : {0.66, 1.5}) {
      const auto far = refract(wi, wm, eta);
      if (!far || far->z >= 0) continue;
      REQUIRE(distance(transmission_half_vector(wi, *far, eta), wm) < 100 * kRounding);
    }
  });
}

TEST_CASE("the Jacobian of reflection is the ratio of areas, both ways") {
  for_seen_normals(6, 100, 0.05, [](const Vec3<double>& wi, const Vec3<double>& wm) {
    const auto wo = reflect(wi, wm);
    const double jacobian = reflection_jacobian(dot(wi, wm));
    REQUIRE(area_ratio([&](const auto& m) { return reflect(wi, m); }, wm) ==
            Approx(jacobian).epsilon(1e-6));
    if (wo.z > 0)
      REQUIRE(area_ratio([&](const auto& w) { return reflection_half_vector(wi, w); }, wo) ==
              Approx(1 / jacobian).epsilon(1e-6));
  });
}

TEST_CASE("the Jacobian of refraction is the ratio of areas, both ways and for either direction") {
  RandomInputs random(7);
  for (const double eta : {0.66, 1.1, 1.5, 2.5})
    for (int i = 0; i < 100; ++i) {
      const auto wi = random_direction(random, 80), wm = random_direction(random, 60);
      const auto wo = refract(wi, wm, eta);
      if (dot(wi, wm) < 0.05 || !wo || dot(*wo, wm) > -0.05 || wo->z >= 0) continue;
      const double jacobian = refraction_jacobian(dot(wi, wm), dot(*wo, wm), eta);
      CAPTURE(eta, dot(wi, wm), dot(*wo, wm));
      REQUIRE(area_ratio([&](const auto& m) { return *refract(wi, m, eta); }, wm) ==
              Approx(jacobian).epsilon(1e-5));
      REQUIRE(area_ratio([&](const auto& w) { return transmission_half_vector(wi, w, eta); },
                         *wo) == Approx(1 / jacobian).epsilon(1e-5));
      REQUIRE(area_ratio([&](const auto& m) { return *refract(*wo, m, 1 / eta); }, wm) ==
              Approx(refraction_jacobian(dot(*wo, wm), dot(wi, wm), 1 / eta)).epsilon(1e-5));
    }
}

TEST_CASE("an outgoing density is 0 where the map has no inverse, and always finite") {
  CHECK(outgoing_density(2.0, 4.0) == 0.5);
  CHECK(outgoing_density(2.0, 0.0) == 0);
  CHECK(outgoing_density(0.0, 0.0) == 0);
  CHECK(outgoing_density(1e30f, 1e-30f) == std::numeric_limits<float>::max());
  CHECK(outgoing_density(2.0, std::numeric_limits<double>::infinity()) == 0);
  CHECK(refraction_jacobian(0.5, -0.5, 1.0) == 0);
}

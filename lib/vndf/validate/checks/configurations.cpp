// The configurations at which checks are made.
#include "vndf/validate/checks/configurations.h"

#include <cmath>
#include <limits>

namespace vndf::validate {
namespace {

/// What a component of a normal may be off by, some roundings of single precision.
constexpr double kRounding = 5e-7;

std::vector<Configuration> flat_check_configurations() {
  return {at_angles(0, 0, 0.5, 0.5),
          at_angles(1e-3, 70, 1, 1),
          at_angles(0.25, 0, 1, 1),
          at_angles(10, 20, 0.1, 0.1),
          at_angles(30, 45, 2, 1),
          at_angles(45, 300, 0.001, 0.001),
          at_angles(50, 160, 0.01, 5),
          at_angles(60, 45, 2, 1),
          at_angles(75, 100, 0.3, 0.9),
          at_angles(80, 0, 10, 10),
          at_angles(85, 0, 1, 1),
          at_angles(89, 200, 0.2, 0.2),
          at_angles(89.9, 10, 1, 0.01),
          at_angles(89.999, 0, 0.5, 0.5),
          at_angles(90 - 1e-7, 120, 0.7, 2),
          at_angles(90, 30, 1, 1),
          at_angles(90.01, 20, 0.5, 0.5),
          at_angles(110, 100, 0.3, 0.9),
          at_angles(150, 300, 2, 1)};
}

std::vector<Configuration> flat_inverse_configurations() {
  std::vector<Configuration> list;
  for (const double theta :
       {0.0,  1e-7, 1e-4, 1e-2, 0.05,  0.1,   0.2,    0.25,    0.3,       0.7,  2.0,  5.0,
        10.0, 17.0, 25.0, 34.0, 45.0,  52.0,  60.0,   68.0,    75.0,      80.0, 84.0, 87.0,
        88.5, 89.2, 89.7, 89.9, 89.97, 89.99, 89.999, 89.9999, 90 - 1e-7, 90.0})
    list.push_back(at_angles(theta, 0, 1, 1));
  for (const double theta : {20.0, 55.0, 82.0, 89.5}) {
    list.push_back(at_angles(theta, 90, 0.3, 0.9));
    list.push_back(at_angles(theta, 0, 0.002, 2));
    list.push_back(at_angles(theta, 33, 0.05, 0.4));
  }
  for (const double theta : {90.0001, 90.5, 95.0, 110.0, 130.0, 150.0, 165.0})
    list.push_back(at_angles(theta, 0, 1, 1));
  list.push_back(at_angles(100, 33, 0.3, 0.9));
  return list;
}

bool is_carried(const Configuration& c) {
  return c.surface().rounding() <= kMostRounding;
}

/// Those of `flat`, on the surface of `sampler`, that are claimed and carried.
std::vector<Configuration> tested(const SamplerUnderTest& sampler,
                                  const std::vector<Configuration>& flat) {
  std::vector<Configuration> list;
  for (const Configuration& f : flat) {
    const Configuration c = on_surface(sampler, f);
    if (is_carried(c) && sampler.claims_to_see(c)) list.push_back(c);
  }
  return list;
}

Side side(const std::vector<Configuration>& list, const Bounds& bounds, bool is_above) {
  Side s{{}, bounds, 0};
  for (const Configuration& c : list) {
    if ((c.height() >= 0) != is_above) continue;
    s.list.push_back(c);
    s.rounding = std::max(s.rounding, kRounding * (c.surface().rounding() - 1));
  }
  s.bounds.u_error += s.rounding;
  // The slopes that are visible from far below differ by little, so that their rounding is most of
  // the u-error which tables are certified to have there, and neighbours may differ by it.
  if (!is_above) s.rounding += bounds.u_error;
  return s;
}

}  // namespace

Configuration on_surface(const SamplerUnderTest& sampler, const Configuration& flat) {
  if (!sampler.surface) return flat;
  const SurfaceSlopes slopes = sampler.surface(flat.alpha);
  Configuration c =
      at_angles(0, 0, slopes.alpha.x, slopes.alpha.y, slopes.correlation, slopes.mean);
  const double across = flat.wi.x * c.mean.x + flat.wi.y * c.mean.y;
  double height = flat.wi.z;
  // Where nothing is added the horizon itself stays among the configurations.
  if (across != 0 && height >= 0) height = std::max(height, kRounding * (1 + std::abs(across)));
  const Vec3<double> w{flat.wi.x, flat.wi.y, height + across};
  const double length = std::hypot(w.x, w.y, w.z);
  c.wi = across == 0 ? flat.wi
                     : Vec3<double>{to_single(w.x / length), to_single(w.y / length),
                                    to_single(w.z / length)};
  return c;
}

double without_height_rounding(double error, const Configuration& c) {
  const double rounding = kRounding * (std::abs(c.wi.x * c.mean.x) + std::abs(c.wi.y * c.mean.y));
  return error <= rounding / std::abs(c.height()) ? 0 : error - rounding / std::abs(c.height());
}

std::vector<Configuration> check_configurations(const SamplerUnderTest& sampler) {
  return tested(sampler, flat_check_configurations());
}

std::vector<Configuration> inverse_configurations(const SamplerUnderTest& sampler) {
  auto list = tested(sampler, flat_inverse_configurations());
  std::erase_if(list, [&](const Configuration& c) { return !sampler.claims.inverse_at(c); });
  return list;
}

std::vector<Place> left_out(const SamplerUnderTest& sampler) {
  std::vector<Place> places;
  for (const Configuration& f : flat_check_configurations()) {
    const Configuration c = on_surface(sampler, f);
    if (!is_carried(c)) places.push_back(place_of(c));
  }
  return places;
}

Side side_above(const SamplerUnderTest& sampler, const std::vector<Configuration>& list) {
  return side(list, sampler.bounds, true);
}

Side side_below(const SamplerUnderTest& sampler, const std::vector<Configuration>& list) {
  return side(list, sampler.bounds_below, false);
}

}  // namespace vndf::validate

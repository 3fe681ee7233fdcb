// The exact distribution of sampled normals.
#include "vndf/validate/exact/exact_distribution.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vndf::validate {
namespace {

constexpr double kPi = std::numbers::pi;

/// Visible V-cavity area of the slopes of one radius with |phi| above pi - psi, over cos t. The
/// weights of x and -x sum to twice cos t, so that all of one radius together are as visible as
/// from above: pi at psi = pi. Finite up to the horizon, where it is the weight 2 of the half that
/// is seen.
double v_cavity_mass(double cosine, double sine, const StretchedSlope& s, double psi) {
  const double vertical = cosine * s.w, horizontal = sine * s.horizontal();
  if (horizontal == 0) return psi;
  if (vertical >= horizontal) return psi + horizontal / vertical * std::sin(psi);
  const double rest = std::asin(vertical / horizontal), psi1 = kPi / 2 - rest;
  if (psi <= psi1) return 2 * psi;  // here -x > c: weight 2 cos t
  // From psi1 + 2 rest on x > c. Between, 1 + cos(psi) / sin(rest) is integrated.
  const double seen = std::min(psi - psi1, 2 * rest);
  const double tilt =
      rest > 0 ? 2 * std::sin(rest - seen / 2) * std::sin(seen / 2) / std::sin(rest) : 0;
  return 2 * psi1 + seen + tilt;
}

/// CDF of x on V-cavities, at sinh(a): the density min((c - x)+, 2 c) P(x) / c, integrated.
double v_cavity_marginal(const precompute::UnitSlopes& slopes, const BoundedSlope<double>& c,
                         double a) {
  const double edge = std::log(c.sigma / c.complement), b = std::abs(a);
  if (a <= -edge) return 2 * slopes.q(b);
  if (a >= edge) return 1;
  const double below = a < 0 ? slopes.q(b) : 1 - slopes.q(b);
  if (std::isinf(edge)) return below;
  return slopes.q(edge) + below + (slopes.m(b) - slopes.m(edge)) / c.slope();
}

}  // namespace

ExactSlopes::ExactSlopes(std::unique_ptr<const distributions::SlopeDistribution> distribution)
    : distribution_(std::move(distribution)),
      slopes_(*distribution_, {}),
      all_radii_(slopes_, bounded_cotangent(1.0, 0.0)) {}

double ExactSlopes::d(const Vec3<double>& wm, const ExactSurface& surface) const {
  const double mu = slopes_.mean_slope();
  if (!(wm.z > 0)) return 0;
  const Vec2<double> s = surface.unit_slope(wm);
  const double r = std::hypot(s.x, s.y) / (mu * wm.z);
  const double square = wm.z * wm.z;
  return slopes_.p22(r) / (mu * mu * surface.determinant() * square * square);
}

double ExactSlopes::visible_area(const Vec3<double>& w, const ExactSurface& surface) const {
  const double horizontal = slopes_.mean_slope() * surface.horizontal(w);
  const double height = surface.height(w), above = std::max(height, 0.0);
  if (horizontal == 0) return above;
  return above + horizontal * slopes_.backfacing(std::abs(height) / horizontal).value;
}

double ExactSlopes::unit_visible_area(const Vec3<double>& w, const ExactSurface& surface) const {
  const double horizontal = slopes_.mean_slope() * surface.horizontal(w);
  return visible_area(w, surface) / std::hypot(horizontal, surface.height(w));
}

double ExactSlopes::lambda(const Vec3<double>& w, const ExactSurface& surface) const {
  const double horizontal = slopes_.mean_slope() * surface.horizontal(w);
  const double height = std::abs(surface.height(w));
  if (horizontal == 0) return 0;
  return horizontal * slopes_.backfacing(height / horizontal).value / height;
}

double ExactSlopes::g1(const Vec3<double>& w, const ExactSurface& surface) const {
  return 1 / (1 + lambda(w, surface));
}

double facing_stretch(const ExactSlopes& exact, const Configuration& c) {
  const auto [least, most] = std::minmax(c.alpha.x, c.alpha.y);
  return 1 + most * exact.unit_slopes().mean_slope() + std::hypot(c.mean.x, c.mean.y) +
         std::abs(c.correlation) * most / least;
}

StretchedFrame::StretchedFrame(const ExactSlopes& exact, const Configuration& c)
    : surface_(c.surface()), mean_slope_(exact.unit_slopes().mean_slope()) {
  const Vec3<double> w = surface_.stretched(c.wi);
  const double length = std::hypot(w.x, w.y);
  const Vec2<double> x = length > 0 ? Vec2<double>{w.x / length, w.y / length} : surface_.along_x();
  cos_ = x.x;
  sin_ = x.y;
  cotangent_ = bounded_cotangent(w.z, mean_slope_ * length);
}

StretchedSlope StretchedFrame::slope_of(const Vec3<double>& wm) const {
  const Vec2<double> s = surface_.unit_slope(wm);
  const double x = s.x / mean_slope_, y = s.y / mean_slope_;
  return {cos_ * x + sin_ * y, cos_ * y - sin_ * x, wm.z};
}

Vec3<double> StretchedFrame::normal_of(const StretchedSlope& s) const {
  const double x = mean_slope_ * (cos_ * s.x - sin_ * s.y);
  const double y = mean_slope_ * (sin_ * s.x + cos_ * s.y);
  const Vec3<double> m = surface_.normal_of({x, y}, s.w);
  const double length = std::hypot(m.x, m.y, m.z);
  return {m.x / length, m.y / length, m.z / length};
}

double StretchedFrame::rounding(const StretchedSlope& s) const {
  const double factor = surface_.rounding();
  return factor * s.horizontal() / s.w + (factor - 1) / mean_slope_;
}

double StretchedFrame::jacobian(const Vec3<double>& wm) const {
  return surface_.determinant() * mean_slope_ * mean_slope_ * wm.z * wm.z * wm.z;
}

ExactDistribution::ExactDistribution(const ExactSlopes& exact, SampledNormals kind,
                                     const Configuration& c, Use use)
    : exact_(exact),
      kind_(kind),
      wi_(c.wi),
      surface_(c.surface()),
      frame_(exact, c),
      height_(c.height()),
      cosine_(frame_.cotangent().numerator() / frame_.cotangent().hypotenuse()),
      sine_(frame_.cotangent().denominator() / frame_.cotangent().hypotenuse()),
      area_(kind == SampledNormals::visible_smith ? exact.visible_area(wi_, surface_) : height_),
      own_radii_(kind == SampledNormals::visible_smith && use == Use::many
                     ? std::make_unique<RadialDistribution>(exact.unit_slopes(), frame_.cotangent())
                     : nullptr),
      visible_(exact.unit_slopes(), kind == SampledNormals::visible_smith
                                        ? frame_.cotangent()
                                        : bounded_cotangent(1.0, 0.0)) {}

Probability<double> ExactDistribution::radius_cdf(const StretchedSlope& s) const {
  const double a = std::asinh(s.horizontal() / s.w);
  if (own_radii_) return own_radii_->cdf(a);
  if (kind_ != SampledNormals::visible_smith) return exact_.all_radii().cdf(a);
  return radial_cdf(exact_.unit_slopes(), exact_.all_radii(), frame_.cotangent(), a);
}

double ExactDistribution::azimuth_cdf(const StretchedSlope& s) const {
  const double psi = std::atan2(std::abs(s.y), -s.x);
  const double h = s.horizontal();
  double share = psi / kPi;
  if (kind_ == SampledNormals::visible_v_cavity) {
    share = v_cavity_mass(cosine_, sine_, s, psi) / kPi;
  } else if (kind_ == SampledNormals::visible_smith) {
    const AngularMass mass = angular_mass(cosine_, sine_, h, s.w);
    const double inside = std::min(psi, kPi - mass.phi0);
    if (mass.half > 0) share = (cosine_ * s.w * inside + sine_ * h * std::sin(inside)) / mass.half;
  }
  share = std::clamp(share, 0.0, 1.0);
  return s.y > 0 ? share / 2 : 1 - share / 2;
}

double ExactDistribution::marginal_cdf(const StretchedSlope& s) const {
  const double a = s.x == 0 ? 0 : std::asinh(s.x / s.w);
  if (kind_ == SampledNormals::visible_v_cavity)
    return v_cavity_marginal(exact_.unit_slopes(), frame_.cotangent(), a);
  return visible_.cdf(std::min(a, visible_.farthest())).u;
}

Uniforms ExactDistribution::uniforms(const Vec3<double>& wm, double v) const {
  const StretchedSlope s = frame_.slope_of(wm);
  if (wm.z >= kSmallestHeight) return {radius_cdf(s).u, azimuth_cdf(s), marginal_cdf(s)};
  // The tails of r and, on the side that is seen, of x are powers of the same radius.
  const StretchedSlope edge{s.x, s.y, kSmallestHeight};
  const double tail = radius_cdf(edge).complement;
  const double u = marginal_cdf(edge);
  return {1 - tail * v, azimuth_cdf(edge), s.x < 0 ? u * v : 1 - (1 - u) * v};
}

double ExactDistribution::pdf_if_seen(const Vec3<double>& wm, double cosine) const {
  const double d = exact_.d(wm, surface_);
  if (kind_ == SampledNormals::all) return d * wm.z;
  if (!(cosine > 0)) return 0;
  if (kind_ == SampledNormals::visible_smith) return d * cosine / area_;
  // Along the surface every facet that is seen is masked by its twin.
  return d * (height_ > 0 ? std::min(cosine / height_, 2 * wm.z) : 2 * wm.z);
}

double ExactDistribution::facing_pdf(const Vec3<double>& wm) const {
  return pdf_if_seen(wm, 1);
}

double ExactDistribution::pdf(const Vec3<double>& wm) const {
  return pdf_if_seen(wm, dot(wi_, wm));
}

}  // namespace vndf::validate

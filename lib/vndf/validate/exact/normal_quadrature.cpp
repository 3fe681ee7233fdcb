// Quadrature over the hemisphere of normals.
#include "vndf/validate/exact/normal_quadrature.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "vndf/log_curve.h"

namespace vndf::validate {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr unsigned kRadialPoints = 10, kAzimuthPoints = 20;
constexpr std::size_t kPanels = 16;  // of each segment, and kPanelsPerUnit more
constexpr double kPanelsPerUnit = 4;
constexpr double kUncovered = 1e-8;       // mass that may be left out
constexpr double kLargestDensity = 1e36;  // that single precision is asked to carry
constexpr double kLargestSlope = 1e36;    // likewise
constexpr Grading kGrading = Grading::both;

struct Rule {
  std::vector<double> at, weight;  // on [0, 1]
};

template <unsigned Points>
Rule rule() {
  using Gauss = boost::math::quadrature::gauss<double, Points>;
  Rule r;
  for (std::size_t k = 0; k < Gauss::abscissa().size(); ++k)
    for (const double sign : {-1.0, 1.0}) {
      if (Gauss::abscissa()[k] == 0 && sign > 0) continue;
      r.at.push_back((1 + sign * Gauss::abscissa()[k]) / 2);
      r.weight.push_back(Gauss::weights()[k] / 2);
    }
  return r;
}

/// The largest density of the four normals along the axes of the stretch whose stretched slope is
/// sinh(a).
double steepest_density(const ExactSlopes& exact, const Configuration& c, double a) {
  const double r = std::sinh(a) * exact.unit_slopes().mean_slope();
  const ExactSurface surface = c.surface();
  const auto d = [&](double x, double y) {
    const Vec3<double> m = surface.normal_of({x, y}, 1);
    const double length = std::hypot(m.x, m.y, m.z);
    return exact.d({m.x / length, m.y / length, m.z / length}, surface);
  };
  return std::max({d(r, 0), d(-r, 0), d(0, r), d(0, -r)}) / exact.visible_area(c.wi, surface);
}

/// asinh of the largest radius: all but kUncovered of the mass, or what single precision carries.
double farthest(const ExactSlopes& exact, const RadialDistribution& radii, const Configuration& c) {
  constexpr double kMargin = 16;
  const double mu = exact.unit_slopes().mean_slope();
  const double carried = 1 / (kMargin * kSmallestHeight * std::max(c.alpha.x, c.alpha.y) * mu);
  double low = 0;
  double high = std::asinh(std::min({carried, kLargestSlope, exact.unit_slopes().support()}));
  if (std::isfinite(exact.unit_slopes().support())) return high;
  while (!(steepest_density(exact, c, high) < kLargestDensity)) high -= 1;
  if (radii.cdf(high).complement > kUncovered) return high;
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (radii.cdf(middle).complement > kUncovered ? low : high) = middle;
  }
  return high;
}

std::vector<double> segment_ends(const ExactSlopes& exact, double cotangent, double end) {
  std::vector<double> ends{0, cotangent, end};
  for (const double r : exact.unit_slopes().distribution().breaks())
    ends.push_back(std::asinh(r / exact.unit_slopes().mean_slope()));
  std::erase_if(ends, [&](double a) { return a > end; });
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

class Nodes {
 public:
  Nodes(const ExactSlopes& exact, SampledNormals kind, const Configuration& c)
      : kind_(kind),
        frame_(exact, c),
        cosine_(frame_.cotangent().numerator() / frame_.cotangent().hypotenuse()),
        sine_(frame_.cotangent().denominator() / frame_.cotangent().hypotenuse()) {}

  NormalQuadrature fill(const std::vector<double>& ends) {
    for (std::size_t s = 0; s + 1 < ends.size(); ++s) add_segment(ends[s], ends[s + 1]);
    return std::move(result_);
  }

 private:
  void add_segment(double begin, double end) {
    static const Rule radial = rule<kRadialPoints>();
    const double width = end - begin;
    const auto panels = kPanels + static_cast<std::size_t>(kPanelsPerUnit * width);
    const double step = 1 / static_cast<double>(panels);
    for (std::size_t p = 0; p < panels; ++p)
      for (std::size_t k = 0; k < radial.at.size(); ++k) {
        const double t = (static_cast<double>(p) + radial.at[k]) * step;
        const double a = begin + width * graded_inverse(t, kGrading);
        add_ring(a, radial.weight[k] * step * width * graded_inverse_derivative(t, kGrading));
      }
  }

  /// Azimuths psi = pi - |phi| of one radius, between the places where the density has a kink.
  void add_ring(double a, double weight) {
    const double r = std::sinh(a);
    double seen = kPi;
    if (kind_ != SampledNormals::all) seen -= angular_mass(cosine_, sine_, r, 1).phi0;
    if (kind_ == SampledNormals::visible_v_cavity && seen < kPi) {
      add_arc(r, weight * r * std::cosh(a), 0, kPi - seen);
      add_arc(r, weight * r * std::cosh(a), kPi - seen, seen);
    } else {
      add_arc(r, weight * r * std::cosh(a), 0, seen);
    }
  }

  void add_arc(double r, double weight, double from, double to) {
    static const Rule azimuth = rule<kAzimuthPoints>();
    for (std::size_t k = 0; k < azimuth.at.size(); ++k) {
      const double psi = from + (to - from) * azimuth.at[k];
      for (const double side : {-1.0, 1.0}) {
        const Vec3<double> wm = frame_.normal_of({-r * std::cos(psi), side * r * std::sin(psi), 1});
        result_.wm.push_back(wm);
        result_.weight.push_back(weight * azimuth.weight[k] * (to - from) * frame_.jacobian(wm));
      }
    }
  }

  SampledNormals kind_;
  StretchedFrame frame_;
  double cosine_, sine_;
  NormalQuadrature result_;
};

}  // namespace

NormalQuadrature normal_quadrature(const ExactSlopes& exact, SampledNormals kind,
                                   const Configuration& c) {
  const StretchedFrame frame(exact, c);
  const bool smith = kind == SampledNormals::visible_smith;
  const RadialDistribution own(exact.unit_slopes(),
                               smith ? frame.cotangent() : bounded_cotangent(1.0, 0.0));
  const double end = farthest(exact, own, c);
  const double cotangent =
      std::abs(std::log(frame.cotangent().sigma / frame.cotangent().complement));
  auto result = Nodes(exact, kind, c).fill(segment_ends(exact, cotangent, end));
  result.covered = own.cdf(end).u;
  return result;
}

}  // namespace vndf::validate

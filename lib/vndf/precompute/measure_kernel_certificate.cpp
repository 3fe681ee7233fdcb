// Measures baked tables by the steps of kernel_text.h.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "vndf/precompute/conditional_distribution.h"
#include "vndf/precompute/function_errors.h"
#include "vndf/precompute/map_errors.h"
#include "vndf/precompute/marginal_distribution.h"
#include "vndf/precompute/measure_kernel_certificate.h"
#include "vndf/precompute/row_errors.h"

namespace vndf::precompute {
namespace {

using kernel::VndfDirection;
using kernel::VndfDraw;
using kernel::VndfTables;

constexpr double kDegree = std::numbers::pi / 180;
// Baked tables have no grid of their own, so rows and columns are those of a pair of this size.
constexpr std::size_t kNominalSize = 1024;

/// The CDF of a slope that is not a number. It becomes an infinite error, so that broken tables get
/// a certificate instead of an exception.
constexpr Probability<double> kNoProbability{std::numeric_limits<double>::quiet_NaN(),
                                             std::numeric_limits<double>::quiet_NaN()};

/// Clamps u to the ends that the kernel clamps it to.
float kernel_u(const Probability<double>& u) {
  return std::clamp(static_cast<float>(u.u), kernel::kVndfLeastU, kernel::kVndfMostU);
}

Probability<double> given_to_kernel(const Probability<double>& u) {
  return from_tail(kernel_u(u));
}

/// Returns the powers of two from both ends to one half, at which cells of baked tables begin.
std::vector<Probability<double>> edges_of_keys() {
  std::vector<Probability<double>> edges;
  for (int k = 1; k <= 25; ++k) {
    edges.push_back(from_tail(std::ldexp(1, -k)));
    edges.push_back(from_complement(std::ldexp(1, -k)));
  }
  return edges;
}

double value(const kernel::float4& cubic, double f) {
  return cubic[0] + f * (cubic[2] + f * (cubic[1] + f * double{cubic[3]}));
}

/// Returns the power of two by which places of the upper half of an axis are larger.
double apart(kernel::uint octaves) {
  return kernel::float_of(0x3f800000u + octaves);
}

/// One of the cubics over u that a draw has used. It can be evaluated in double precision next to
/// the place of the draw.
class FollowedCubic {
 public:
  /// The cubic of lane 0, which takes u1, or of lane 2, which takes u2.
  FollowedCubic(const VndfTables& tables, const VndfDraw& draw, int lane)
      : tables_(tables),
        cubic_(lane == 0 ? draw.marginal : draw.conditional),
        upper_(draw.upper[lane] != 0),
        start_(double{draw.places[lane]} - double{draw.f[lane]}) {
    if (lane == 0 && upper_) apart_ = apart(tables.column_upper - kernel::kVndfSign);
    mirrored_ = lane != 0 && tables.separable == 0 && draw.places[lane] > tables.column_span / 2;
    if (mirrored_) apart_ = apart(tables.column_mirror);
  }

  bool upper() const { return upper_; }

  double at(const Probability<double>& u) const {
    const double q = upper_ ? u.complement : u.u;
    const double p =
        tables_.column_roots != 0 ? std::sqrt(2 * q) + double{tables_.column_offset} : q;
    return value(cubic_, apart_ * (mirrored_ ? tables_.column_span - p : p) - start_);
  }

 private:
  const VndfTables& tables_;
  kernel::float4 cubic_;
  bool upper_, mirrored_;
  double apart_ = 1, start_;
};

/// The root of sigma at the place of a draw and next to it, in double precision. It is the cubic
/// over u1, followed by the map where the tables have one for the direction.
class FollowedRoot {
 public:
  FollowedRoot(const VndfTables& tables, const VndfDirection& direction, const VndfDraw& draw)
      : tables_(tables), direction_(direction), draw_(draw), over_u_(tables, draw, 0) {}

  double at(const Probability<double>& u) const {
    const bool is_root = tables_.separable != 0 || direction_.kind == kernel::kVndfBelow;
    const double root = is_root ? over_u_.at(u) * double{direction_.edge} : mapped(over_u_.at(u));
    return std::clamp(root, double{tables_.least_root}, double{tables_.most_root});
  }

 private:
  double mapped(double s) const {
    const double side = draw_.s > tables_.slope_middle ? 1 : -1;
    const double far = side > 0 ? apart(tables_.slope_upper) : 1;
    const double place = far * std::min(side * (s - tables_.slope_middle) + tables_.slope_offset,
                                        double{tables_.slope_most});
    const double start = double{kernel::vndf_slope_place(tables_, draw_.s)} - double{draw_.map_f};
    return value(draw_.map, place - start);
  }

  const VndfTables& tables_;
  const VndfDirection& direction_;
  const VndfDraw& draw_;
  FollowedCubic over_u_;
};

/// A slope x in the terms of the kernel.
struct KernelSlope {
  double sigma;

  double d() const { return sigma * (1 - sigma); }
  /// In units of VndfTables::unit.
  double x() const { return (sigma - 0.5) / d(); }
};

/// Converts slopes of the kernel into units of the mean slope.
class KernelUnits {
 public:
  KernelUnits(const VndfTables& tables, double mean_slope)
      : tables_(tables), unit_(tables.unit / mean_slope) {}

  double x(const KernelSlope& slope) const { return unit_ * slope.x(); }

  /// The scale of y given x. It is computed in double precision, because near a rim it changes
  /// within the rounding of x.
  double scale(const KernelSlope& slope) const {
    const double x = slope.x(), rim = tables_.rim;
    if (rim > 0) return unit_ * std::sqrt(std::max((rim - x) * (rim + x), 0.0));
    return unit_ * (tables_.scale_root * std::hypot(1, x) + tables_.scale_constant);
  }

 private:
  const VndfTables& tables_;
  double unit_;
};

/// Slope x over u1 at one incidence.
class MarginalRow final : public RowMap {
 public:
  MarginalRow(const VndfTables& tables, const KernelUnits& units, const VndfDirection& direction,
              const MarginalDistribution& visible)
      : tables_(tables), units_(units), direction_(direction), visible_(visible) {}

  Probability<double> given(const Probability<double>& u) const override {
    return given_to_kernel(u);
  }
  Probability<double> cdf(const Probability<double>& u) const override {
    const float root = draw(u).root, sigma = root * root;
    return cdf_of(sigma);
  }
  Probability<double> tail_cdf(const Probability<double>& u) const override {
    return smooth_cdf(u, u);
  }
  Probability<double> smooth_cdf(const Probability<double>& u,
                                 const Probability<double>& place) const override {
    const VndfDraw drawn = draw(place);
    const double root = FollowedRoot(tables_, direction_, drawn).at(u);
    return cdf_of(root * root);
  }

 private:
  VndfDraw draw(const Probability<double>& u) const {
    return vndf_draw(tables_, direction_, kernel_u(u), 0.5f);
  }
  /// The slope is clamped to the cotangent, as the kernel clamps it.
  Probability<double> cdf_of(double sigma) const {
    const double a = std::asinh(units_.x({sigma}));
    return std::isnan(a) ? kNoProbability : visible_.cdf(std::min(a, visible_.farthest()));
  }

  const VndfTables& tables_;
  const KernelUnits& units_;
  const VndfDirection& direction_;
  const MarginalDistribution& visible_;
};

/// A direction and a random number for which the kernel draws some slope x.
struct SlopePlace {
  VndfDirection direction;
  float u1;
};

/// Slope y over u2 at one slope x.
class ConditionalRow final : public RowMap {
 public:
  /// `scale` is the scale of y over that of `conditional`.
  ConditionalRow(const VndfTables& tables, const SlopePlace& place, double scale,
                 const ConditionalDistribution& conditional)
      : tables_(tables), place_(place), scale_(scale), conditional_(conditional) {}

  Probability<double> given(const Probability<double>& u) const override {
    return given_to_kernel(u);
  }
  Probability<double> cdf(const Probability<double>& u) const override { return cdf_of(draw(u).v); }
  Probability<double> tail_cdf(const Probability<double>& u) const override {
    return smooth_cdf(u, u);
  }
  Probability<double> smooth_cdf(const Probability<double>& u,
                                 const Probability<double>& place) const override {
    const FollowedCubic cubic(tables_, draw(place), 2);
    return cdf_of(cubic.upper() ? -cubic.at(u) : cubic.at(u));
  }

 private:
  VndfDraw draw(const Probability<double>& u) const {
    return vndf_draw(tables_, place_.direction, place_.u1, kernel_u(u));
  }
  Probability<double> cdf_of(double v) const {
    if (std::isnan(v)) return kNoProbability;
    const double half = conditional_.cdf(std::abs(v) * scale_).complement / 2;
    return v < 0 ? from_tail(half) : from_complement(half);
  }

  const VndfTables& tables_;
  const SlopePlace& place_;
  double scale_;
  const ConditionalDistribution& conditional_;
};

/// The kernel with its rows that are compared with the exact distribution.
struct MeasuredKernel {
  const UnitSlopes& slopes;
  const VndfTables& tables;
  KernelUnits units;

  /// A direction whose stretched cotangent is z / s. Its parts are floats and count as exact.
  struct Direction {
    float z, s;
  };

  Direction direction(const BoundedSlope<double>& c) const {
    const double z = c.numerator(), s = c.denominator() / slopes.mean_slope();
    const double length = std::hypot(z, s);
    return {static_cast<float>(z / length), static_cast<float>(s / length)};
  }

  VndfDirection at(const Direction& w) const { return vndf_at(tables, {w.s, 0, w.z}, 1, 1); }

  TableErrors marginal_row(const Direction& w, std::size_t index) const {
    const MarginalDistribution visible(slopes,
                                       bounded_cotangent(double{w.z}, w.s * slopes.mean_slope()));
    const VndfDirection stretched = at(w);
    return measure_row(MarginalRow(tables, units, stretched, visible),
                       {std::atan2(w.s, w.z) / kDegree, marginal_column_inverse<double>,
                        kNominalSize, edges_of_keys()},
                       index);
  }

  /// Finds where a slope next to `x`, in units of the mean slope, is drawn: at normal incidence if
  /// it is above 0, at grazing incidence if it is below.
  SlopePlace place_of(double x) const {
    const VndfDirection w = at(x > 0 ? Direction{1, 0} : Direction{0, 1});
    const auto sigma = bounded_from_slope(x * slopes.mean_slope() / tables.unit).sigma;
    return {w, vndf_bisect(tables, w, static_cast<float>(sigma), 0.5f, false)};
  }

  float sigma_at(const SlopePlace& place) const {
    const float root = vndf_draw(tables, place.direction, place.u1, 0.5f).root;
    return root * root;
  }

  TableErrors conditional_row(const SlopePlace& place, std::size_t index) const {
    const KernelSlope slope{sigma_at(place)};
    const double x = std::abs(units.x(slope));
    const ConditionalDistribution conditional(slopes, x, plain_scale(slopes));
    return measure_row(
        ConditionalRow(tables, place, units.scale(slope) / conditional.scale(), conditional),
        {x * slopes.mean_slope(), conditional_u2, kNominalSize, edges_of_keys()}, index);
  }
};

/// Measures rows at base coordinates from `first` to `first` + 1, and at more incidences.
template <class Incidences, class Measures>
TableErrors marginal_errors(const MeasuredKernel& measured, double first,
                            const Incidences& incidences, Measures measures,
                            const support::Workers& workers) {
  std::vector<MeasuredKernel::Direction> directions;
  for (const double row : off_grid_rows(kNominalSize, kMeasuredRows))
    directions.push_back(measured.direction(marginal_base_inverse(first + row)));
  for (const double degrees : incidences)
    directions.push_back({static_cast<float>(std::cos(degrees * kDegree)),
                          static_cast<float>(std::sin(degrees * kDegree))});
  std::erase_if(directions, [&](const MeasuredKernel::Direction& w) {
    return !measures(bounded_cotangent(double{w.z}, w.s * measured.slopes.mean_slope()));
  });
  return measure_rows(directions.size(), workers,
                      [&](std::size_t i) { return measured.marginal_row(directions[i], i); });
}

TableErrors conditional_errors(const MeasuredKernel& measured, const support::Workers& workers) {
  std::vector<SlopePlace> places;
  double side = 1;
  for (const double row : off_grid_rows(kNominalSize, kMeasuredRows)) {
    side = -side;
    const SlopePlace place = measured.place_of(side * conditional_base_inverse(row));
    const float sigma = measured.sigma_at(place);
    const double x = std::abs(measured.units.x({sigma}));
    // A slope beyond the first or the last u1 is never drawn.
    if (kernel::vndf_inside(place.u1) && measures_conditional(measured.slopes, x, sigma))
      places.push_back(place);
  }
  return measure_rows(places.size(), workers,
                      [&](std::size_t i) { return measured.conditional_row(places[i], i); });
}

}  // namespace

Certificate measure_certificate(const UnitSlopes& slopes, const Kernel& kernel,
                                const support::Workers& workers) {
  const VndfTables& tables = kernel.tables();
  const MeasuredKernel measured{slopes, tables, KernelUnits(tables, slopes.mean_slope())};
  Certificate certificate;
  certificate.marginal = marginal_errors(
      measured, 0, kHardIncidences, [](const auto&) { return true; }, workers);
  if (tables.below.most_cotangent > 0)
    certificate.below = marginal_errors(
        measured, 1, kHardIncidencesBelow, [&](const auto& c) { return measures_below(slopes, c); },
        workers);
  certificate.conditional = conditional_errors(measured, workers);
  FunctionErrors(slopes, kernel).measure(certificate, workers);
  return certificate;
}

}  // namespace vndf::precompute

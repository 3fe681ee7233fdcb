// The quantile functions of the pair in the kernel's terms.
#include "vndf/baking/pair_slopes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vndf::baking {
namespace {

// Next to q = 1/2 the value of the conditional and its column both change like a root, so that the
// quotient of their derivatives has no digits. The derivative by q is that of this column instead,
// where 1/2 - q = 1e-6.
constexpr double kLeastColumn = 1e-3;

// Nearer to 0 or 1 the square of sigma or its complement leaves the range or the digits of double
// precision.
constexpr double kLeastSigma = 1e-300, kLeastComplement = 0x1p-50;
// Slopes that are rarer than this are not looked at: a picture of 1e9 samples shows none of them.
constexpr double kRare = 1e-9;
// At the rim of bounded slopes the scale of y is 0 and no conditional is left; rounding may carry
// an x beyond. The row here stands for it.
constexpr double kInsideRim = 1 - 1e-9;

/// sigma of x / `unit`, given sigma of x, with its derivative by the same argument.
Node in_unit(const Node& sigma, double unit) {
  const double inside = std::clamp(sigma.value, kLeastSigma, 1 - 0x1p-52);
  const double n = inside - 0.5, d = inside * (1 - inside);
  const double value = bounded_from_fraction(n, unit * d).sigma, e = value * (1 - value);
  // dx / dsigma = (1/2 - d) / d^2
  const double rate = (0.5 - d) / (0.5 - e) * (e / d) * (e / d) / unit;
  return {value, sigma.derivative * rate};
}

/// The root of sigma, with its derivative by the same argument.
Node root_of(const Node& sigma) {
  const double root = std::sqrt(std::max(sigma.value, kLeastSigma));
  return {root, sigma.derivative / (2 * root)};
}

/// The units that are worth trying. Where the conditional has rows, a unit takes half of the time
/// of baking; 2 and 8 besides 1 and 4 would save 4 % of the bytes at most.
std::vector<double> units_of(const SlopeTables& pair) {
  if (!conditional_factorises(pair)) return {1, 4};
  if (pair.conditional_quadratic <= 0) return {1, 2, 4, 8};
  return {std::sqrt(pair.conditional_constant / pair.conditional_quadratic)};
}

}  // namespace

double KernelScale::at(double x) const {
  if (rim > 0)
    return std::sqrt(std::max((rim - x) * (rim + x), std::numeric_limits<double>::min()));
  return root * std::hypot(1, x) + constant;
}

PairSlopes::PairSlopes(const SlopeTables& pair, double unit)
    : pair_(pair),
      coordinates_(pair),
      unit_(unit),
      separable_(conditional_factorises(pair)),
      middle_(static_cast<float>(coordinates_.marginal_map.inverse(0.5))) {
  if (std::isfinite(pair.support))
    scale_.rim = pair.support / unit;
  else if (separable_ && pair.conditional_quadratic == 0)
    scale_.constant = 1;
  else
    scale_.root = 1;
}

double PairSlopes::direction_row(double g, bool below) const {
  const double z = unit_ * (1 - g);
  // The horizon itself is above.
  return coordinates_.marginal_row(bounded_cotangent(below ? -z : z, g));
}

double PairSlopes::g_of(const BoundedSlope<double>& c) const {
  const double horizontal = unit_ * c.denominator();
  return horizontal / (horizontal + std::abs(c.numerator()));
}

double PairSlopes::lowest_g() const {
  return g_of(coordinates_.marginal_row_inverse(1));
}

double PairSlopes::most_cotangent() const {
  if (std::isinf(pair_.support)) return std::numeric_limits<double>::infinity();
  return (1 - lowest_g()) / lowest_g();
}

Node PairSlopes::stored(double row, double q, bool upper) const {
  const double t =
      marginal_column(upper ? Probability<double>{1 - q, q} : Probability<double>{q, 1 - q});
  const auto s = pair_.marginal.lookup_with_derivative(row, t);
  const double du = marginal_column_rate(t);
  return {s.value, s.derivative / (upper ? -du : du)};
}

Node PairSlopes::marginal(double row, double q, bool upper) const {
  const Node node = stored(row, q, upper);
  if (!separable_) return node;
  const Node root = map(node.value);
  return {root.value, root.derivative * node.derivative};
}

Node PairSlopes::marginal_below(double row, double q, bool upper) const {
  const BoundedSlope<double> c = coordinates_.marginal_row_inverse(row);
  const double scale = marginal_scale(c);
  const double edge = std::sqrt(g_of(c));
  const Node s = stored(row, q, upper);
  const Node sigma = coordinates_.marginal_map.at_with_derivative(s.value);
  const Node root =
      root_of(in_unit({scale * sigma.value, scale * sigma.derivative * s.derivative}, unit_));
  return {root.value / edge, root.derivative / edge};
}

Node PairSlopes::map(double s) const {
  return root_of(in_unit(coordinates_.marginal_map.at_with_derivative(s), unit_));
}

double PairSlopes::marginal_inverse(double row, double root, bool upper) const {
  const double square = root * root;
  const double n = square - 0.5, d = square * (1 - square);
  const double sigma = bounded_from_fraction(unit_ * n, d).sigma;
  const double scale = marginal_scale(coordinates_.marginal_row_inverse(row));
  const double s = coordinates_.marginal_map.inverse(sigma / scale);
  const auto u = marginal_column_inverse(pair_.marginal.inverse(row, s));
  return upper ? u.complement : u.u;
}

double PairSlopes::slope_at(double s) const {
  const double root = map(s).value, sigma = root * root;
  return std::abs(sigma - 0.5) / (sigma * std::max(1 - sigma, kLeastComplement));
}

double PairSlopes::least_s() const {
  const double column = marginal_column(Probability<double>{kRare, 1 - kRare});
  return pair_.marginal.lookup(direction_row(1, false), column);
}

double PairSlopes::most_s() const {
  const double column = marginal_column(Probability<double>{1 - kRare, kRare});
  return pair_.marginal.lookup(direction_row(0, false), column);
}

double PairSlopes::least_root() const {
  const BoundedSlope<double> c = coordinates_.marginal_row_inverse(1);
  const double column = marginal_column(Probability<double>{kRare, 1 - kRare});
  const double sigma = coordinates_.marginal_map.at(pair_.marginal.lookup(1, column));
  return root_of(in_unit({marginal_scale(c) * sigma, 0}, unit_)).value;
}

PairSlopes::ConditionalRow PairSlopes::conditional_row(double slope) const {
  const double x = scale_.rim > 0 ? std::min(slope, kInsideRim * scale_.rim) : slope;
  const auto bounded = bounded_from_slope(x * unit_);
  const double scale =
      coordinates_.scale.at({bounded.numerator(), bounded.denominator()}) / bounded.denominator();
  return {coordinates_.conditional_row(bounded), scale / (unit_ * scale_.at(x))};
}

Node PairSlopes::conditional(const ConditionalRow& row, double q) const {
  const double column = conditional_column(Probability<double>{1 - 2 * q, 2 * q});
  const double t = std::max(column, kLeastColumn);
  const auto beside = pair_.conditional.lookup_with_derivative(row.row, t);
  const double v = t == column ? beside.value : pair_.conditional.lookup(row.row, column);
  const double rate = -2 * beside.derivative / conditional_column_rate(t);  // dv / dq
  const double e = (1 - v) * (1 + v);
  return {-row.scale * 2 * v / e, -row.scale * 2 * (1 + v * v) / (e * e) * rate};
}

double PairSlopes::log2_ndf(double x) const {
  const double r = x * unit_;
  // D = p22 (1 + r^2)^2, and p22 in units of U is U^2 times that.
  const double log_p22 = pair_.log_ndf.log_at(std::asinh(r)) - 2 * std::log1p(r * r);
  return (log_p22 + 2 * std::log(unit_) + 2 * std::log1p(x * x)) / std::log(2.0);
}

double PairSlopes::log2_backfacing(double c) const {
  return (pair_.log_backfacing.log_at(std::asinh(c * unit_)) - std::log(unit_)) / std::log(2.0);
}

std::vector<PairSlopes> pair_in_units(const SlopeTables& pair) {
  std::vector<PairSlopes> list;
  for (const double unit : units_of(pair)) list.emplace_back(pair, unit);
  return list;
}

}  // namespace vndf::baking

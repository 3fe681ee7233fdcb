// Inverts the base distribution at equidistant columns.
#include "vndf/precompute/marginal_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vndf/differences.h"
#include "vndf/precompute/asinh_slope.h"
#include "vndf/precompute/tabulated_cdf.h"
#include "vndf/table_coordinates.h"

namespace vndf::precompute {
namespace {

// Width of the panels in asinh(slope). Smooth densities need no less than 0.25, as in
// conditional_distribution.cpp; narrower panels follow a narrow part of a mixture wherever it lies.
constexpr double kPanel = 0.04;
constexpr double kFarthest = 700;  // exp(-700) is near the end of double precision
// Panels are halved this often towards 0 and the breaks, down to 4e-14.
constexpr int kHalvings = 40;
// The base probability of the first of kMapPieces columns is above 1e-15, and panels beyond which
// less of the moment is left than this would change nothing.
constexpr double kSmallestMoment = 1e-16;

/// The density of which the map is the quantile function, P / sigma over a = asinh(slope), up to a
/// factor.
struct BaseDensity {
  const UnitSlopes* slopes;

  double operator()(double a) const { return slopes->p_da(a) * (1 + std::exp(-a)); }
};

/// The place at which the mass of `p` ends, counted from the nearer end.
double quantile(const TabulatedCdf<BaseDensity>& base, const Probability<double>& p) {
  constexpr double kMiddle = std::numeric_limits<double>::quiet_NaN();  // no guess
  return p.u < 0.5 ? base.inverse_below(p.u * base.below_last(), kMiddle, Rounding::difference)
                   : base.inverse_above(p.complement * base.above_first(), kMiddle);
}

/// Returns edges of panels over asinh(slope) >= 0, narrower towards 0 and the breaks.
std::vector<double> panel_edges(const UnitSlopes& slopes) {
  const double end = std::min(kFarthest, std::asinh(slopes.support()));
  std::vector<double> edges{0, end};
  const auto add = [&](double edge) {
    if (edge > 0 && edge < end) edges.push_back(edge);
  };
  const auto add_around = [&](double place) {
    add(place);
    for (int k = 1; k <= kHalvings; ++k)
      for (const double side : {-1.0, 1.0}) add(place + side * std::ldexp(kPanel, -k));
  };
  for (int k = 1; kPanel * k < end; ++k) add(kPanel * k);
  add_around(0);
  for (const double r : slopes.distribution().breaks())
    add_around(std::asinh(r / slopes.mean_slope()));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  while (edges.size() > 2 && slopes.m(edges[edges.size() - 2]) < kSmallestMoment) edges.pop_back();
  return edges;
}

std::vector<double> mirrored(const std::vector<double>& half) {
  std::vector<double> edges;
  for (std::size_t k = half.size(); k-- > 1;) edges.push_back(-half[k]);
  edges.insert(edges.end(), half.begin(), half.end());
  return edges;
}

/// Sets the tangents of the first and the last node to those of the parabola through the value and
/// tangent of the neighbour, because those of the map itself may be 0 or infinite.
void set_end_tangents(std::vector<CubicNode<double>>& nodes) {
  const auto parabola = [](const auto& end, const auto& beside) {
    return 2 * std::abs(beside.value - end.value) - beside.tangent;
  };
  const std::size_t last = nodes.size() - 1;
  nodes[0].tangent = parabola(nodes[0], nodes[1]);
  nodes[last].tangent = parabola(nodes[last], nodes[last - 1]);
}

/// Clamps the tangents to what keeps the map increasing.
void limit_tangents(std::vector<CubicNode<double>>& nodes) {
  const auto value = [&](std::size_t k) { return nodes[k].value; };
  for (std::size_t k = 0; k < nodes.size(); ++k)
    nodes[k].tangent = std::clamp(nodes[k].tangent, 0.0, steepest_tangent(value, nodes.size(), k));
}

}  // namespace

std::vector<CubicNode<double>> marginal_map(const UnitSlopes& slopes, std::size_t pieces) {
  const TabulatedCdf base(BaseDensity{&slopes}, mirrored(panel_edges(slopes)));
  const double spacing = 1 / static_cast<double>(pieces);
  std::vector<CubicNode<double>> map{{0, 0}};
  for (std::size_t k = 1; k < pieces; ++k) {
    const double t = spacing * static_cast<double>(k);
    const auto p = marginal_column_inverse(t);
    const double a = quantile(base, p);
    const auto sigma = bounded_from_asinh(a);
    // The logit of sigma is a, so its derivative by a is sigma (1 - sigma).
    const double da_dt = marginal_column_rate(t) / (base.density(a) / base.below_last());
    // Where the density jumps within a panel, its integral is not exact and may turn back.
    const double value = std::max(map.back().value, sigma.sigma);
    map.push_back({value, sigma.denominator() * da_dt * spacing});
  }
  map.push_back({bounded_from_slope(slopes.support()).sigma, 0});
  set_end_tangents(map);
  limit_tangents(map);
  return map;
}

}  // namespace vndf::precompute

// The CDF of a density of one variable and the inverse of that, from integrals over panels.
//
// The masses below and above the edge of each panel are both kept. Each is a sum of positive terms,
// so the smaller of the two keeps its relative precision in either tail, where the difference from
// the whole would lose it. The part of a panel is integrated by Gauss's rule.
#pragma once

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "vndf/cubic_piece.h"
#include "vndf/distributions/slope_integrals.h"
#include "vndf/support/increasing_root.h"
#include "vndf/table_coordinates.h"

namespace vndf::precompute {

/// The step of Newton's method that ends the search for a quantile. The error that is left is about
/// the square of the step, so that another step would be lost in rounding.
inline constexpr support::LastStep kQuantileStep{
    .relative = 1e-8, .absolute = 4 * std::numeric_limits<double>::epsilon()};

/// What is rounded first where the mass below x is compared with another: the sum of the panels
/// below and the part of the panel of x, or the difference of the other mass and the panels below.
/// x moves by a rounding. Each caller keeps its order, so that its tables are the same to the last
/// bit.
enum class Rounding { sum, difference };

/// `Density` is a function of one double, >= 0 and smooth within each panel. It need not be
/// normalised: masses are its integrals as it is.
template <class Density>
class TabulatedCdf {
 public:
  /// Integrates over the panels between consecutive `edges`, which increase, by Gauss's rule.
  TabulatedCdf(const Density& density, const std::vector<double>& edges)
      : TabulatedCdf(density, edges, integrals(density, edges), {0, 0}) {}

  /// Takes the integrals over the panels and over all that lies beyond the last edge.
  TabulatedCdf(Density density, std::vector<double> edges,
               const std::vector<distributions::Estimate>& panels,
               const distributions::Estimate& beyond)
      : density_(std::move(density)),
        edge_(std::move(edges)),
        below_(edge_.size(), 0),
        above_(edge_.size(), beyond.value) {
    for (std::size_t k = 0; k < panels.size(); ++k) {
      below_[k + 1] = below_[k] + panels[k].value;
      error_ += panels[k].error;
    }
    error_ += beyond.error;
    for (std::size_t k = panels.size(); k-- > 0;) above_[k] = above_[k + 1] + panels[k].value;
  }

  double density(double x) const { return density_(x); }
  double last_edge() const { return edge_.back(); }

  /// The masses below the last edge and above the first, summed from either end. Where nothing lies
  /// beyond the last edge they differ by rounding only.
  double below_last() const { return below_.back(); }
  double above_first() const { return above_.front(); }

  /// Error of above_first() as the given integrals estimate theirs.
  double error() const { return error_; }

  /// The shares of above_first() below and above `x`, which is at least the first edge: the smaller
  /// is integrated, the other is its complement. Beyond the last edge, all that was given for there
  /// lies above `x`.
  Probability<double> cdf(double x) const {
    const std::size_t k = panel_of(x);
    if (above_[k] < above_first() / 2) {
      const double part = x < last_edge() ? integral(density_, x, edge_[k + 1]) : 0;
      const double tail = (above_[k + 1] + part) / above_first();
      return {1 - tail, tail};
    }
    const double head = (below_[k] + integral(density_, edge_[k], x)) / above_first();
    return {head, 1 - head};
  }

  /// x below which lies `mass`, to kQuantileStep; at most the last edge. `guess` may save steps.
  /// One outside the panel of x stands for its middle.
  double inverse_below(double mass, double guess, Rounding order) const {
    const auto above = std::upper_bound(below_.begin() + 1, below_.end() - 1, mass);
    const auto k = static_cast<std::size_t>(above - below_.begin()) - 1;
    const auto excess = [&](double x) {
      const double part = integral(density_, edge_[k], x);
      const double value =
          order == Rounding::sum ? below_[k] + part - mass : part - (mass - below_[k]);
      return WithDerivative<double>{value, density_(x)};
    };
    return root_in_panel(excess, k, guess);
  }

  /// The same with `mass` above x.
  double inverse_above(double mass, double guess) const {
    const std::size_t k = panel_of_mass_above(mass);
    const auto lack = [&](double x) {
      return WithDerivative<double>{mass - (above_[k + 1] + integral(density_, x, edge_[k + 1])),
                                    density_(x)};
    };
    return root_in_panel(lack, k, guess);
  }

  /// inverse_above() by Hermite interpolation of x over the mass, which costs two densities: good
  /// to 3e-4 of a panel for smooth densities, as a guess for the others.
  double interpolated_inverse_above(double mass) const {
    const std::size_t k = panel_of_mass_above(mass);
    const double whole = above_[k] - above_[k + 1], width = edge_[k + 1] - edge_[k];
    const double f = (above_[k] - mass) / whole;
    // A curve with a steeper tangent than this at an end could turn back.
    const double steepest = kSteepest * width;
    const double left = std::min(steepest, whole / density_(edge_[k]));
    const double right = std::min(steepest, whole / density_(edge_[k + 1]));
    return edge_[k] +
           f * (left + f * (3 * width - 2 * left - right + f * (left + right - 2 * width)));
  }

 private:
  static double integral(const Density& density, double low, double high) {
    return boost::math::quadrature::gauss<double, 10>::integrate(density, low, high);
  }

  static std::vector<distributions::Estimate> integrals(const Density& density,
                                                        const std::vector<double>& edges) {
    std::vector<distributions::Estimate> panels;
    for (std::size_t k = 1; k < edges.size(); ++k)
      panels.push_back({integral(density, edges[k - 1], edges[k]), 0});
    return panels;
  }

  std::size_t panel_of(double x) const {
    const auto above = std::upper_bound(edge_.begin() + 1, edge_.end() - 1, x);
    return static_cast<std::size_t>(above - edge_.begin()) - 1;
  }

  std::size_t panel_of_mass_above(double mass) const {
    const auto below =
        std::lower_bound(above_.begin() + 1, above_.end() - 1, mass, std::greater<>());
    return static_cast<std::size_t>(below - above_.begin()) - 1;
  }

  template <class F>
  double root_in_panel(const F& f, std::size_t panel, double guess) const {
    return support::increasing_root(f, edge_[panel], edge_[panel + 1], guess, kQuantileStep);
  }

  Density density_;
  std::vector<double> edge_, below_, above_;  // above_ with what lies beyond the last edge
  double error_ = 0;
};

}  // namespace vndf::precompute

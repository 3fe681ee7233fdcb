// Slope distributions from formulas that a user types, so that a distribution of one's own needs no
// C++. A formula is a slope density p22(r), or a normal distribution D(theta) or D(theta, alpha),
// where theta is the angle from the mean normal and p22(r) = D(atan(r)) cos^4(atan(r)).
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "vndf/distributions/compiled_formula.h"
#include "vndf/distributions/slope_distribution.h"

namespace vndf::distributions {

/// D(theta, alpha); the formula need not use alpha. Any number of threads may call it.
class NdfFormula {
 public:
  /// Throws std::invalid_argument as CompiledFormula does.
  explicit NdfFormula(const Formula& formula) : formula_(formula, {"theta", "alpha"}) {}

  const std::string& text() const { return formula_.text(); }
  bool uses_alpha() const { return formula_.uses("alpha"); }

  /// D at 0 <= theta <= pi / 2.
  double operator()(double theta, double alpha) const { return formula_(theta, alpha); }

  /// The slope density D cos^4 at slope r >= 0, precise up to grazing normals.
  double p22(double r, double alpha) const;

 private:
  CompiledFormula formula_;
};

/// Most breaks of a formula, and where they may lie. The builder samples curves at 8192 places
/// between any two of them, and looks for slopes where diagnose() does.
inline constexpr std::size_t kMaxBreaks = 16;
inline constexpr double kNearestBreak = 1e-8, kFarthestBreak = 1e8;

/// A slope distribution whose density is a formula. If the formula is 0 beyond some radius, as in
/// "r < 2 ? 1 - r/2 : 0", this radius is found and becomes the support.
class FormulaDistribution final : public SlopeDistribution {
 public:
  /// p22 as a formula in r, with the radii at which it jumps or has a kink. Throws as
  /// CompiledFormula does, and std::invalid_argument unless breaks are at most kMaxBreaks, finite
  /// and > 0.
  static FormulaDistribution from_p22(const Formula& formula,
                                      const std::vector<double>& breaks = {});

  /// p22 as a function of the caller's, in place of a formula. Of the same numbers it is the same
  /// distribution. Throws std::invalid_argument for breaks as above.
  static FormulaDistribution from_function(std::string name, std::function<double(double)> p22,
                                           const std::vector<double>& breaks = {});

  /// The surface of roughness `alpha` of a normal distribution, in its natural slopes r =
  /// tan(theta). For a shape-invariant D (shape_invariance.h) alpha = 1 is unit roughness. Throws
  /// std::invalid_argument unless alpha is finite and > 0 and breaks, in r, are within the limits
  /// above.
  static FormulaDistribution from_ndf(const NdfFormula& ndf, double alpha = 1,
                                      const std::vector<double>& breaks = {});

  /// "p22(r) = exp(-a*r), a=2" or "D(theta) = ...", with the alpha of a D that uses it.
  std::string name() const override { return name_; }

  /// Slopes beyond 1e20 at which the arithmetic overflows to something that is not a number
  /// (r^2 * exp(-r^2) is infinity times 0) count as density 0.
  double p22(double r) const override;
  /// A formula of D is costly, because it needs trigonometric functions besides.
  bool costly() const override { return costly_; }
  std::vector<double> breaks() const override { return breaks_; }
  double support() const override { return support_; }

 private:
  FormulaDistribution(std::string name, std::function<double(double)> density, bool costly,
                      const std::vector<double>& breaks);

  std::string name_;
  std::function<double(double)> density_;
  bool costly_;
  double support_;
  std::vector<double> breaks_;  // increasing, up to the support, which is among them if finite
};

}  // namespace vndf::distributions

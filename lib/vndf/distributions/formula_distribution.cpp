// Slope densities from formulas in r or in theta.
#include "vndf/distributions/formula_distribution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "vndf/support/text.h"

namespace vndf::distributions {

double NdfFormula::p22(double r, double alpha) const {
  const double square = 1 + r * r;
  return formula_.at_slope(r, alpha) / square / square;
}

namespace {

/// Radius beyond which `p22` is 0, infinite if there is none. A density that merely sinks below the
/// smallest number, as exp(-r^2) does, ends nowhere.
template <class P22>
double end_of(P22 p22) {
  constexpr double kFarthest = 1e8, kNearest = 1e-8, kStep = 1.25;
  constexpr double kSunk = 1e-250, kJustInside = 1 - 1e-9;
  constexpr int kHalvings = 64;
  const double infinity = std::numeric_limits<double>::infinity();
  double zero = kFarthest;
  while (zero > kNearest && p22(zero / kStep) == 0) zero /= kStep;
  if (zero == kFarthest || zero <= kNearest) return infinity;
  double positive = zero / kStep;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (positive + zero) / 2;
    (p22(middle) == 0 ? zero : positive) = middle;
  }
  return p22(zero * kJustInside) > kSunk ? zero : infinity;
}

std::vector<double> checked_breaks(std::vector<double> breaks, double support) {
  if (breaks.size() > kMaxBreaks)
    throw std::invalid_argument("the formula has " + std::to_string(breaks.size()) +
                                " breaks; at most " + std::to_string(kMaxBreaks) + " are allowed");
  for (const double r : breaks)
    if (!(r >= kNearestBreak && r <= kFarthestBreak))
      throw std::invalid_argument("the break at slope radius " + support::number_text(r) +
                                  " must be a number from " + support::number_text(kNearestBreak) +
                                  " to " + support::number_text(kFarthestBreak));
  std::erase_if(breaks, [&](double r) { return r > support * (1 - 1e-9); });
  if (std::isfinite(support)) breaks.push_back(support);
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  return breaks;
}

}  // namespace

FormulaDistribution::FormulaDistribution(std::string name, std::function<double(double)> density,
                                         bool costly, const std::vector<double>& breaks)
    : name_(std::move(name)),
      density_(std::move(density)),
      costly_(costly),
      support_(end_of([this](double r) { return p22(r); })),
      breaks_(checked_breaks(breaks, support_)) {}

FormulaDistribution FormulaDistribution::from_p22(const Formula& formula,
                                                  const std::vector<double>& breaks) {
  const CompiledFormula compiled(formula, {"r"});
  return {"p22(r) = " + compiled.text(), [compiled](double r) { return compiled(r); }, false,
          breaks};
}

FormulaDistribution FormulaDistribution::from_function(std::string name,
                                                       std::function<double(double)> p22,
                                                       const std::vector<double>& breaks) {
  return {std::move(name), std::move(p22), false, breaks};
}

FormulaDistribution FormulaDistribution::from_ndf(const NdfFormula& ndf, double alpha,
                                                  const std::vector<double>& breaks) {
  if (!(alpha > 0) || !std::isfinite(alpha))
    throw std::invalid_argument("the roughness alpha of D is " + support::number_text(alpha) +
                                "; it must be a finite number > 0");
  const std::string at = ndf.uses_alpha() ? ", alpha=" + support::number_text(alpha) : "";
  return {"D(theta) = " + ndf.text() + at, [ndf, alpha](double r) { return ndf.p22(r, alpha); },
          true, breaks};
}

double FormulaDistribution::p22(double r) const {
  constexpr double kFar = 1e20;
  const double density = density_(r);
  return r > kFar && !std::isfinite(density) ? 0 : density;
}

}  // namespace vndf::distributions

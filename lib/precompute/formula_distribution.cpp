// Slope densities from formulas in r or in theta.
#include "precompute/formula_distribution.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "precompute/words.h"

namespace vndf::precompute {

double NdfFormula::p22(double r, double alpha) const {
  const double square = 1 + r * r;
  return formula_.at_slope(r, alpha) / square / square;
}

FormulaDistribution::FormulaDistribution(std::string name, std::function<double(double)> density,
                                         bool costly)
    : name_(std::move(name)), density_(std::move(density)), costly_(costly) {}

FormulaDistribution FormulaDistribution::from_p22(const Formula& formula) {
  const CompiledFormula compiled(formula, {"r"});
  return {"p22(r) = " + compiled.text(), [compiled](double r) { return compiled(r); }, false};
}

FormulaDistribution FormulaDistribution::from_ndf(const NdfFormula& ndf, double alpha) {
  if (!(alpha > 0) || !std::isfinite(alpha))
    throw std::invalid_argument("the roughness alpha of D is " + number_text(alpha) +
                                "; it must be a finite number > 0");
  const std::string at = ndf.uses_alpha() ? ", alpha=" + number_text(alpha) : "";
  return {"D(theta) = " + ndf.text() + at, [ndf, alpha](double r) { return ndf.p22(r, alpha); },
          true};
}

double FormulaDistribution::p22(double r) const {
  constexpr double kFar = 1e20;
  const double density = density_(r);
  return r > kFar && !std::isfinite(density) ? 0 : density;
}

}  // namespace vndf::precompute

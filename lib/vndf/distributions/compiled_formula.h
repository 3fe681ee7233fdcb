// A formula of one or two variables, checked once and evaluated by muParser from any number of
// threads.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace vndf::distributions {

/// Longest formula in characters, its parameters and the letters of their names, and how many
/// parentheses may be open. A formula
/// that a person writes keeps them by far. A longer one would make every build slow, because its
/// density is evaluated some 1e7 times.
inline constexpr std::size_t kMaxFormulaLength = 2000, kMaxFormulaParameters = 32,
                             kMaxParameterName = 32, kMaxFormulaDepth = 64;

/// A formula and the numbers that its names stand for. It may use + - * / ^, comparisons, && ||,
/// CONDITION ? A : B, the constants pi and e, and the functions abs acos acosh asin asinh atan
/// atan2 atanh cos cosh exp ln log (natural) log2 log10 max min pow rint sign sin sinh sqrt tan
/// tanh.
struct Formula {
  std::string text;
  std::map<std::string, double> parameters;
};

/// Copies share one definition.
class CompiledFormula {
 public:
  /// `variables` are the names of the one or two arguments. Throws std::invalid_argument, one line
  /// with the formula, the column (from 1) and what is wrong there, for a formula that cannot be
  /// understood and for an unknown name (with the nearest known one); and, naming it, for a
  /// parameter that has no usable name or that the formula does not use. Each message quotes 60
  /// characters at most. It throws likewise for a formula beyond one of the limits above.
  CompiledFormula(const Formula& formula, const std::vector<std::string>& variables);

  /// The formula with its parameters, "exp(-a*r), a=2".
  const std::string& text() const;
  bool uses(const std::string& name) const;

  /// The value; not a number or infinite where the arithmetic is.
  double operator()(double first, double second = 0) const;

  /// The value where the first variable is the angle atan(r), r >= 0. Its cosine, sine and tangent
  /// are taken from r, for near pi / 2 the angle itself no longer tells them.
  double at_slope(double r, double second = 0) const;

  struct Definition;  ///< internal

 private:
  std::shared_ptr<const Definition> definition_;
};

}  // namespace vndf::distributions

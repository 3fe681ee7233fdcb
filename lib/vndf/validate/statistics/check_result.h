// The result of a check: one statistic, its bound, and the place where it is worst.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "vndf/validate/exact/configuration.h"

namespace vndf::validate {

/// How the measured value is compared with the bound.
enum class Kind {
  error,       ///< an error, which must not be larger
  probability  ///< the smallest p-value of `tests` independent tests, which must not be smaller
};

/// What one statistic of a check was, and what it may be.
struct CheckResult {
  std::string check = {};      ///< which check was made, as "density"
  std::string statistic = {};  ///< what it measured, as "integral of pdf - 1"
  Kind kind = Kind::error;
  double measured = 0;
  double bound = 0;  ///< for a p-value it is set when all tests of the run are known
  Place where = {};
  std::size_t tests = 0;  ///< how many p-values were made, of which `measured` is the smallest
  std::string note = {};  ///< what else is to be told, as text

  /// False for a measurement that is not a number.
  bool passed() const { return kind == Kind::error ? measured <= bound : measured >= bound; }
};

/// A check, or one statistic of it, that was not made, and why. A verdict that says nothing of it
/// would be taken for one that includes it.
struct SkippedCheck {
  std::string check;              ///< as that of a CheckResult
  std::string statistic;          ///< empty for the whole check
  std::string reason;             ///< why, as a text that follows "not run:"
  std::vector<Place> where = {};  ///< the configurations without it; empty for all of them
};

/// Whether every result passed.
inline bool all_passed(const std::vector<CheckResult>& results) {
  return std::all_of(results.begin(), results.end(),
                     [](const CheckResult& f) { return f.passed(); });
}

/// The largest of several errors and where it was. What is not a number counts as larger than any.
struct Worst {
  double measured = 0;
  Place where = {};

  /// Takes account of an error at a place.
  void see(double error, const Place& place) {
    if (!(error <= measured) && !std::isnan(measured)) {
      measured = error;
      where = place;
    }
  }
  void see(const Worst& other) { see(other.measured, other.where); }

  /// The largest error as a result, with its bound.
  CheckResult result(std::string check, std::string statistic, double bound) const {
    return {std::move(check), std::move(statistic), Kind::error, measured, bound, where};
  }
};

/// Takes account of each of `others` in the one of `all` at the same place.
template <class... W>
void see_each(const std::tuple<W&...>& all, const std::tuple<const W&...>& others) {
  std::apply(
      [&](W&... mine) { std::apply([&](const W&... other) { (mine.see(other), ...); }, others); },
      all);
}

}  // namespace vndf::validate
